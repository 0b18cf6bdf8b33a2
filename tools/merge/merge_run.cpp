// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/merge/merge_run.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "common/bus/node/stages.hpp"
#include "common/config/config.hpp"
#include "common/files/file_utils.hpp"
#include "common/pose_graph/g2o_file.hpp"
#include "common/pose_graph/optimize.hpp"
#include "tools/map/map_files.hpp"
#include "tools/map/result_folder.hpp"
#include "tools/merge/map_changes.hpp"
#include "tools/merge/merge_files.hpp"
#include "tools/merge/merge_input.hpp"
#include "tools/merge/merge_summary.hpp"
#include "tools/merge/run_groups.hpp"

namespace adit {
namespace {

using Clock = std::chrono::steady_clock;
using Progress = std::function<void(const std::string&, double)>;

// Sections of the configuration for this tool, in addition to those of the stages.
constexpr const char* kGridSection = "map_grid";
constexpr const char* kJoinSection = "merge";
constexpr const char* kChangesSection = "changes";
constexpr double kChangeCellM = 0.1;

ConfigFile load_config(const std::filesystem::path& path) {
  if (path.empty()) return {};
  ConfigFile file = ConfigFile::load(path);
  std::vector<std::string> known = config_sections();
  for (const char* section : {kGridSection, kJoinSection, kChangesSection})
    known.emplace_back(section);
  file.require_known_sections(known);
  return file;
}

/// The map of a run by its own decisions.
std::unique_ptr<Mapping> restored(MergeInput& input, const ConfigFile& config,
                                  const std::filesystem::path& scratch) {
  auto params = load_section<MappingParams>(config, "mapping");
  params.lasers = input.lasers;
  params.scratch = scratch;
  auto map = std::make_unique<Mapping>(params);
  map->restore(std::move(input.map));
  return map;
}

/// Moves the poses to the optimum of the whole graph, and proves that it is the global one where
/// it can.
Certificate optimise(MapGraph& graph) {
  PoseGraph poses = pose_graph_of(graph);
  optimize(poses, {.rotation_initialization = false});
  Certificate certificate = certify(poses);
  graph.poses = poses.poses;
  return certificate;
}

std::vector<MapChange> changes_between(const FullMap& map, const RunGroup& group,
                                       const std::vector<RunInfo>& runs, const ConfigFile& config,
                                       const Progress& progress) {
  auto grid_params = load_section<OccupancyGridParams>(config, kGridSection);
  grid_params.resolution_m = std::max(grid_params.resolution_m, kChangeCellM);
  std::vector<std::size_t> order(group.runs.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, {}, [&](std::size_t i) { return group.runs[i].run; });
  std::vector<OccupancyGrid> grids;
  for (const std::size_t i : order) {
    progress("comparing", static_cast<double>(grids.size()) / static_cast<double>(order.size()));
    grids.emplace_back(grid_params);
    if (!insert_run(map, group, i, runs, grids.back())) return {};
  }
  std::vector<MapChange> changes =
      find_changes(grids, load_section<MapChangesParams>(config, kChangesSection));
  for (MapChange& change : changes) {
    for (std::size_t& run : change.wall_runs) run = order[run];
    for (std::size_t& run : change.free_runs) run = order[run];
  }
  return changes;
}

/// A sentence for each run that is not in the first map.
std::vector<std::string> not_joined_text(const RunGroups& groups,
                                         const std::vector<RunInfo>& runs) {
  std::vector<std::string> sentences;
  const std::size_t map_of = groups.groups().front().runs.front().run;
  for (std::size_t k = 1; k < groups.groups().size(); ++k) {
    const RunGroup& group = groups.groups()[k];
    std::string reason = "not compared";
    for (const RejectedJoin& rejected : groups.rejected()) {
      const std::size_t first = group.runs.front().run;
      const bool between = (rejected.to_run == map_of && rejected.run == first) ||
                           (rejected.to_run == first && rejected.run == map_of);
      if (between || reason == "not compared") reason = rejected.join.reason;
    }
    for (const PlacedRun& placed : group.runs) {
      sentences.push_back(
          fmt::format("{} is not joined (map {}): {}", runs[placed.run].name, k + 1, reason));
    }
  }
  return sentences;
}

}  // namespace

MergeResult run_merge(const MergeOptions& options, const Progress& progress) {
  const auto start = Clock::now();
  const ConfigFile config = load_config(options.config);
  const auto grid_params = load_section<OccupancyGridParams>(config, kGridSection);
  RunGroups groups(load_section<RunJoinParams>(config, kJoinSection));
  const ResultFolder results(options.folder);
  const std::filesystem::path& folder = results.unfinished();
  const std::filesystem::path scratch = folder / "scratch";
  std::filesystem::create_directory(scratch);

  MergeResult result;
  MergeSummary summary;
  for (std::size_t i = 0; i < options.runs.size(); ++i) {
    progress("joining", static_cast<double>(i) / static_cast<double>(options.runs.size()));
    MergeInput input =
        open_run(options.runs[i], options.config, scratch / fmt::format("run_{}", i + 1), progress);
    for (const std::string& warning : input.warnings)
      result.warnings.push_back(fmt::format("{}: {}", input.name, warning));
    summary.runs.push_back({input.name, input.lasers});
    summary.warnings.push_back(input.warnings);
    auto map = restored(input, config, scratch);
    groups.add(std::move(map));
  }
  groups.finish([&](double done) { progress("joining the rest", done); });
  const RunGroup& group = groups.groups().front();

  MapGraph graph = group.map->graph();
  progress("optimising", 0.0);
  summary.optimum = optimise(graph);
  summary.constraints = graph.constraints.size();
  const FullMap map = full_map(group.map->local_maps(), std::move(graph), scratch);
  summary.changes = changes_between(map, group, summary.runs, config, progress);
  progress("writing", 0.0);
  write_trajectories(map, group, folder);
  OccupancyGrid grid(grid_params);
  if (insert_runs(map, group, summary.runs, grid)) {
    write_map_server(grid, folder, "map");
    MapPicture picture = map_picture(map, fmt::format("{} runs", group.runs.size()));
    if (options.draw_graph) picture.graph = graph_picture(map);
    write_map_png(grid, picture, folder / "map.png");
    write_changes(summary.changes, grid, group, folder);
  } else {
    result.warnings.emplace_back("no map: the poses exceed the size limit of map_grid");
  }
  write_g2o(g2o_of(map.graph), folder / "graph.g2o");
  summary.has_journal = write_joined_journal(group, summary.runs, folder);
  if (!summary.has_journal) {
    result.warnings.emplace_back(
        "no map.journal: the lasers of the robots differ, and a map that is resumed has one set");
  }
  result.runs = options.runs.size();
  result.joined = group.runs.size();
  result.local_maps = group.map->local_maps().size();
  for (const PlacedRun& placed : group.runs) {
    if (placed.join) result.links += placed.join->links.size();
  }
  result.changes = summary.changes.size();
  result.is_global = summary.optimum.is_global;
  result.not_joined = not_joined_text(groups, summary.runs);
  result.wall_s = std::chrono::duration<double>(Clock::now() - start).count();
  summary.groups = &groups;
  summary.wall_s = result.wall_s;
  write_text_file(merge_summary_json(summary), folder / "summary.json");
  std::filesystem::remove_all(scratch);
  results.publish();
  return result;
}

}  // namespace adit
