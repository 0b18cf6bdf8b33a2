// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/map_files.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "common/bus/channels.hpp"
#include "common/files/file_utils.hpp"
#include "common/geometry/pose2.hpp"
#include "common/grid/occupancy_grid.hpp"
#include "common/picture/map_picture.hpp"
#include "common/sensing/seconds.hpp"
#include "tools/eval/tum.hpp"

namespace adit {
namespace {

constexpr const char* kHeader =
    "time_s\tdecision\tclosure\tnewer_map\tolder_map\tchosen\tchosen_before\talternatives\t"
    "x_m\ty_m\ttheta_deg\tlog_likelihood\tlog_likelihood_of_all\treason\n";

template <class... Values>
std::string format(const char* pattern, Values... values) {
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(), pattern, values...);
  return text.data();
}

std::string decision(const Association& a) {
  if (a.action == Association::Action::kProposed) {
    return a.chosen == Association::kNone ? "left out" : "closed";
  }
  if (a.chosen == Association::kNone) return "undone";
  return a.previously_chosen == Association::kNone ? "redone" : "changed";
}

/// Counted from 1, the most likely first.
std::string choice(int chosen) {
  return chosen == Association::kNone ? "none" : std::to_string(chosen + 1);
}

/// The alternative that a line is about: what is chosen, or was, or might have been.
const LoopClosureAlternative& described_alternative(const Association& a) {
  int index = 0;
  if (a.previously_chosen != Association::kNone) index = a.previously_chosen;
  if (a.chosen != Association::kNone) index = a.chosen;
  return a.loop_closure.alternatives[static_cast<std::size_t>(index)];
}

std::string line(const Association& a) {
  const LoopClosureAlternative& alternative = described_alternative(a);
  const Pose2& T = alternative.T_older_newer;
  return format("%.6f\t%s\t%d\t%d\t%d\t", seconds(a.utime), decision(a).c_str(), a.loop_closure.id,
                a.loop_closure.newer_map, alternative.older_map) +
         format("%s\t%s\t%zu\t", choice(a.chosen).c_str(), choice(a.previously_chosen).c_str(),
                a.loop_closure.alternatives.size()) +
         format("%.3f\t%.3f\t%.2f\t%.1f\t%.1f\t", T.x, T.y, rad_to_deg(T.theta),
                alternative.log_likelihood, a.log_likelihood) +
         a.reason + "\n";
}

}  // namespace

std::string association_table(const FullMap& map) {
  std::string text = kHeader;
  for (const Association* association : map.associations) text += line(*association);
  return text;
}

namespace {

using Edge = GraphPicture::Edge;

Edge edge_of(const MapGraph& graph, int from, int to) {
  return {graph.poses[static_cast<std::size_t>(from)].translation(),
          graph.poses[static_cast<std::size_t>(to)].translation()};
}

/// What is chosen for each closure at the end.
std::map<int, int> last_choices(const FullMap& map) {
  std::map<int, int> chosen;
  for (const Association* a : map.associations) chosen[a->loop_closure.id] = a->chosen;
  return chosen;
}

std::vector<Edge> revoked_edges(const FullMap& map) {
  const std::map<int, int> in_force = last_choices(map);
  std::set<std::pair<int, int>> revoked;  // older, newer
  for (const Association* a : map.associations) {
    if (a->action != Association::Action::kRevised || a->previously_chosen == Association::kNone ||
        in_force.at(a->loop_closure.id) == a->previously_chosen) {
      continue;
    }
    const auto& before =
        a->loop_closure.alternatives[static_cast<std::size_t>(a->previously_chosen)];
    revoked.insert({before.older_map, a->loop_closure.newer_map});
  }
  std::vector<Edge> edges;
  for (const auto& [older, newer] : revoked) edges.push_back(edge_of(map.graph, older, newer));
  return edges;
}

}  // namespace

G2oGraph g2o_of(const MapGraph& graph) {
  G2oGraph g2o;
  g2o.graph.poses = graph.poses;
  for (std::size_t i = 0; i < graph.poses.size(); ++i) g2o.ids.push_back(static_cast<long>(i));
  for (const auto& constraint : graph.constraints) {
    g2o.graph.constraints.push_back(constraint.measured);
  }
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

namespace {

bool insert_scans(const FullMap& map, const Lasers& lasers, OccupancyGrid& grid) {
  return std::all_of(map.scans.begin(), map.scans.end(), [&](const PlacedScan& placed) {
    const LaserMount& mount = *placed.channel == channels::kLaserRear ? lasers.rear : lasers.front;
    return grid.insert(*placed.scan, placed.T_map_body * mount.T_body_laser);
  });
}

/// Times at which this run did not observe all of its motion, ascending.
std::vector<std::int64_t> unobserved_times(const RunRecord& record) {
  std::vector<std::int64_t> times;
  for (const ScanMatch& match : record.matches()) {
    if (is_unobserved(match)) times.push_back(match.utime);
  }
  return times;
}

/// The degenerate is marked on the path of this run, the last one.
MapPicture picture_of(const FullMap& map, const RunRecord& record, const MapFilesOptions& options) {
  MapPicture picture;
  picture.title = options.title;
  const auto unobserved = unobserved_times(record);
  for (const Trajectory& path : map.paths) {
    const bool of_this_run = &path == &map.paths.back();
    if (!picture.path.empty()) picture.jumps.push_back(picture.path.size());
    for (const TimedPose& pose : path) {
      picture.path.push_back(pose.pose);
      picture.degenerate.push_back(
          of_this_run && std::binary_search(unobserved.begin(), unobserved.end(), pose.utime));
    }
  }
  if (options.draw_graph) picture.graph = graph_picture(map);
  return picture;
}

}  // namespace

bool write_map_files(const FullMap& map, const RunRecord& record, const MapFilesOptions& options,
                     const std::filesystem::path& folder) {
  write_tum(folder / "trajectory.tum", joined_path(map));
  write_tum(folder / "odometry.tum", record.odometry());
  OccupancyGrid grid(options.grid);
  if (!insert_scans(map, options.lasers, grid)) return false;
  write_map_server(grid, folder, "map");
  write_map_png(grid, picture_of(map, record, options), folder / "map.png");
  return true;
}

}  // namespace adit
