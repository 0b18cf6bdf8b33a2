// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/survey.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "common/files/file_utils.hpp"
#include "common/pose_graph/map_correction.hpp"
#include "tools/map/result_folder.hpp"
#include "tools/survey/files/geotiff_file.hpp"
#include "tools/survey/frame/registered_cloud.hpp"
#include "tools/survey/frame/survey_frame.hpp"
#include "tools/survey/frame/survey_graph.hpp"
#include "tools/survey/input/survey_input.hpp"
#include "tools/survey/raster/column_grid.hpp"
#include "tools/survey/raster/elevation_rasters.hpp"
#include "tools/survey/section/cross_section.hpp"
#include "tools/survey/section/section_table.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

constexpr double kEveryMinM = 0.2;
constexpr double kEveryMaxM = 1000.0;
constexpr double kCellMinM = 0.05;
constexpr double kCellMaxM = 1.0;

/// Places of the body on the ground, in survey: each placed by the local map of its time.
std::vector<Eigen::Vector3d> path_in_survey(const MissionMap& map, const SurveyGraph& graph) {
  std::vector<Eigen::Vector3d> path;
  for (const TimedPose& pose : map.path())
    path.push_back(graph.T_survey_map(graph.node_at(pose.utime)) * pose.position());
  return path;
}

/// The scans of the level lasers, each at the place of its local map in survey. Nothing if the
/// poses exceed the size of a grid.
std::optional<OccupancyGrid> occupancy(const SurveyInput& input, const SurveyGraph& graph) {
  FullMap placed;
  for (const SurveyGraph::Node& node : graph.nodes()) {
    const LocalMap& map = *input.map().full_map().local_maps[static_cast<std::size_t>(node.id)];
    for (const LocalScan& scan : map.scans)
      placed.scans.push_back(
          {&scan.channel, &scan.scan, node.T_survey_local.plan * scan.T_local_body});
  }
  OccupancyGrid grid{OccupancyGridParams{}};
  if (!insert_scans(placed, input.log_info().lasers, grid) || grid.observed_box().empty())
    return std::nullopt;
  return grid;
}

void write_rasters(const ColumnGrid& columns, const std::optional<OccupancyGrid>& occupied,
                   const SurveyFrame& frame, const fs::path& folder,
                   std::vector<std::string>& warnings) {
  const std::string& crs = frame.crs_wkt();
  if (columns.columns.size() == 0) {
    warnings.emplace_back("no rasters of elevation: no returns near the path");
  } else {
    write_geotiff(floor_raster(columns, frame), crs, folder / "floor.tif");
    write_geotiff(roof_raster(columns, frame), crs, folder / "roof.tif");
    write_geotiff(height_raster(columns, frame), crs, folder / "height.tif");
    write_geotiff(deviation_raster(columns, frame), crs, folder / "deviation.tif");
  }
  if (!occupied) {
    warnings.emplace_back("no occupancy.tif: the map has no scan, or exceeds the size of a grid");
    return;
  }
  write_geotiff(occupancy_raster(*occupied, frame), crs, folder / "occupancy.tif");
}

void check(const SurveyOptions& options) {
  for (const fs::path& path : options.mission) {
    if (!fs::exists(path))
      throw std::invalid_argument(fmt::format("{}: no such file or folder", path.string()));
  }
  if (!(options.every_m >= kEveryMinM && options.every_m <= kEveryMaxM)) {
    throw std::invalid_argument(
        fmt::format("the distance between cross-sections is {} to {} m", kEveryMinM, kEveryMaxM));
  }
  if (!(options.cell_m >= kCellMinM && options.cell_m <= kCellMaxM)) {
    throw std::invalid_argument(
        fmt::format("the side of a cell is {} to {} m", kCellMinM, kCellMaxM));
  }
}

void add_accuracy(const SurveyGraph& graph, SurveyResult& result) {
  for (const SurveyGraph::Node& node : graph.nodes()) {
    result.plan_sd_max_m = std::max(result.plan_sd_max_m, position_sd_m(node.covariance));
    result.z_sd_max_m = std::max(result.z_sd_max_m, std::sqrt(node.z_variance));
  }
}

}  // namespace

SurveyResult write_survey(const SurveyOptions& options, const SurveyProgress& progress) {
  const auto report = [&](const char* step, double done) {
    if (progress) progress(step, done);
  };
  check(options);
  const SurveyInput input(mission_logs(options.mission),
                          [&](double done) { report("reading", done); });
  report("placing", 0.0);
  const SurveyGraph graph = SurveyGraph::free_network(input.map().full_map());
  const SurveyFrame frame = SurveyFrame::local();
  const RegisteredCloud cloud(input.clouds(), graph);
  const std::vector<Eigen::Vector3d> path = path_in_survey(input.map(), graph);
  const CorridorGraph corridors =
      input.exploration() ? input.exploration()->corridors : CorridorGraph{};
  const std::vector<CentreLine> lines = centre_lines(corridors, graph);

  report("measuring", 0.2);
  const ColumnGrid columns = column_grid(cloud, path, {.cell_m = options.cell_m});
  const auto sections = cross_sections(cloud, section_planes(lines, path, options.every_m));
  const auto occupied = occupancy(input, graph);

  report("writing", 0.6);
  SurveyResult result;
  result.frame = frame.statement();
  result.scans = cloud.scans().size();
  result.points = cloud.points();
  for (const CentreLine& line : lines) result.length_m += line.line.length_m();
  result.sections = sections.size();
  result.void_space = void_volume(columns);
  result.warnings = input.warnings();
  add_accuracy(graph, result);
  const ResultFolder results(options.folder);
  write_rasters(columns, occupied, frame, results.unfinished(), result.warnings);
  write_text_file(section_table(sections, frame), results.unfinished() / "sections.csv");
  write_text_file(outline_table(sections, frame), results.unfinished() / "outlines.csv");
  results.publish();
  report("writing", 1.0);
  return result;
}

}  // namespace adit
