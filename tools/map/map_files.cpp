// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/map_files.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "common/files/file_utils.hpp"
#include "common/geometry/pose2.hpp"
#include "common/grid/occupancy_grid.hpp"
#include "common/picture/map_picture.hpp"
#include "common/sensing/seconds.hpp"
#include "common/text/message_text.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {
namespace {

constexpr const char* kAssociationColumns =
    "time_s\tdecision\tloop_closure\tnewer_map\tolder_map\tchosen\tpreviously_chosen\t"
    "alternatives\tx_m\ty_m\ttheta_deg\tlog_likelihood\tlog_likelihood_of_all\treason\n";

using Edge = GraphPicture::Edge;

/// Alternatives are counted from 1, the most likely one first.
std::string choice(int chosen) {
  return chosen == Association::kNone ? "none" : fmt::to_string(chosen + 1);
}

/// The alternative in a line: the chosen one, otherwise the previously chosen, otherwise the first.
const LoopClosureAlternative& described_alternative(const Association& a) {
  int index = 0;
  if (a.previously_chosen != Association::kNone) index = a.previously_chosen;
  if (a.chosen != Association::kNone) index = a.chosen;
  return a.loop_closure.alternatives[static_cast<std::size_t>(index)];
}

std::string association_line(const Association& a) {
  const LoopClosureAlternative& alternative = described_alternative(a);
  const Pose2& T = alternative.T_older_newer;
  return fmt::format(
      "{:.6f}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{:.3f}\t{:.3f}\t{:.2f}\t{:.1f}\t{:.1f}\t{}\n",
      seconds(a.utime), decision_text(a), a.loop_closure.id, a.loop_closure.newer_map,
      alternative.older_map, choice(a.chosen), choice(a.previously_chosen),
      a.loop_closure.alternatives.size(), T.x, T.y, rad_to_deg(T.theta), alternative.log_likelihood,
      a.log_likelihood, message_line(a.reason));
}

Edge edge_of(const MapGraph& graph, int from, int to) {
  return {graph.poses[static_cast<std::size_t>(from)].translation(),
          graph.poses[static_cast<std::size_t>(to)].translation()};
}

/// The alternative of each loop closure at the end, by id.
std::map<int, int> final_choices(const FullMap& map) {
  std::map<int, int> chosen;
  for (const Association* a : map.associations) chosen[a->loop_closure.id] = a->chosen;
  return chosen;
}

std::vector<Edge> revoked_edges(const FullMap& map) {
  const std::map<int, int> final_choice = final_choices(map);
  std::set<std::pair<int, int>> revoked;  // older, newer
  for (const Association* a : map.associations) {
    if (a->action != Association::Action::kRevised || a->previously_chosen == Association::kNone ||
        final_choice.at(a->loop_closure.id) == a->previously_chosen) {
      continue;
    }
    const auto& alternative =
        a->loop_closure.alternatives[static_cast<std::size_t>(a->previously_chosen)];
    revoked.insert({alternative.older_map, a->loop_closure.newer_map});
  }
  std::vector<Edge> edges;
  for (const auto& [older, newer] : revoked) edges.push_back(edge_of(map.graph, older, newer));
  return edges;
}

void write_path(const std::filesystem::path& file, const Spool<TimedPose>& path) {
  TumWriter writer(
      file, std::ranges::any_of(path, [](const TimedPose& pose) { return pose.z_m != 0.0; }));
  for (const TimedPose& pose : path) writer.add(pose);
  writer.close();
}

void write_joined_path(const std::filesystem::path& file, const FullMap& map) {
  bool with_heights = false;
  visit_joined_path(map, [&](const TimedPose& pose) { with_heights |= pose.z_m != 0.0; });
  TumWriter writer(file, with_heights);
  visit_joined_path(map, [&](const TimedPose& pose) { writer.add(pose); });
  writer.close();
}

/// Marks the poses of this run, the last path, where motion was not fully observed and where the
/// map may be wrong.
void mark_poses(const FullMap& map, const RunRecord& record,
                const std::vector<DoubtfulStretch>& stretches, MapPicture& picture) {
  const Spool<TimedPose>& path = map.paths.back();
  const std::size_t step = pose_step(map);
  const std::size_t drawn = (path.size() + step - 1) / step;
  picture.degenerate.assign(picture.path.size() - drawn, false);
  if (!stretches.empty()) picture.doubtful = picture.degenerate;
  for (std::size_t from = 0; from < path.size(); from += step) {
    bool degenerate = false;
    bool doubtful = false;
    for (std::size_t i = from; i < std::min(from + step, path.size()); ++i) {
      degenerate |= record.unobserved()[i] != 0;
      doubtful |= in_stretches(stretches, path[i].utime);
    }
    picture.degenerate.push_back(degenerate);
    if (!stretches.empty()) picture.doubtful.push_back(doubtful);
  }
}

}  // namespace

const char* decision_text(const Association& a) {
  if (a.action == Association::Action::kProposed) {
    return a.chosen == Association::kNone ? "left open" : "accepted";
  }
  if (a.chosen == Association::kNone) return "revoked";
  return a.previously_chosen == Association::kNone ? "re-accepted" : "revised";
}

std::string association_table(const FullMap& map) {
  std::string text = kAssociationColumns;
  for (const Association* association : map.associations) text += association_line(*association);
  return text;
}

G2oGraph g2o_of(const MapGraph& graph) {
  G2oGraph g2o{pose_graph_of(graph), {}};
  for (std::size_t i = 0; i < graph.poses.size(); ++i) g2o.ids.push_back(static_cast<long>(i));
  return g2o;
}

void write_graph_files(const FullMap& map, const std::filesystem::path& folder) {
  write_g2o(g2o_of(map.graph), folder / "graph.g2o");
  write_text_file(association_table(map), folder / "associations.tsv");
}

GraphPicture graph_picture(const FullMap& map) {
  GraphPicture picture;
  picture.nodes = map.graph.poses;
  for (const auto& [measured, kind] : map.graph.constraints) {
    const Edge edge = edge_of(map.graph, measured.from, measured.to);
    if (kind == MapConstraint::Kind::kLoopClosure) {
      picture.loop_closures.push_back(edge);
    } else if (map.local_maps[static_cast<std::size_t>(measured.from)]->session ==
               map.local_maps[static_cast<std::size_t>(measured.to)]->session) {
      picture.sequential.push_back(edge);
    }
  }
  picture.revoked = revoked_edges(map);
  return picture;
}

MapPicture map_picture(const FullMap& map, const std::string& title) {
  MapPicture picture;
  picture.title = title;
  const std::size_t step = pose_step(map);
  for (const Spool<TimedPose>& path : map.paths) {
    if (!picture.path.empty()) picture.jumps.push_back(picture.path.size());
    for (std::size_t i = 0; i < path.size(); i += step) picture.path.push_back(path[i].pose);
  }
  return picture;
}

std::size_t pose_step(const FullMap& map) {
  std::size_t poses = 0;
  for (const Spool<TimedPose>& path : map.paths) poses += path.size();
  return poses / kPosesDrawn + 1;
}

bool write_map_files(const FullMap& map, const RunRecord& record,
                     const std::vector<DoubtfulStretch>& stretches, const MapFilesOptions& options,
                     const std::filesystem::path& folder) {
  write_joined_path(folder / "trajectory.tum", map);
  write_path(folder / "odometry.tum", record.odometry());
  OccupancyGrid grid(options.grid);
  if (!insert_scans(map, options.lasers, grid)) return false;
  write_map_server(grid, folder, "map");
  MapPicture picture = map_picture(map, options.title);
  mark_poses(map, record, stretches, picture);
  if (options.draw_graph) picture.graph = graph_picture(map);
  write_map_png(grid, picture, folder / "map.png");
  return true;
}

}  // namespace adit
