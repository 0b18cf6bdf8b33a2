// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/map_layers.hpp"

#include "tools/map/graph_files.hpp"
#include "tools/report/svg_parts.hpp"

namespace adit {
namespace {

constexpr double kPathStepUnits = 0.6;  // finer than what is seen

std::string edges(const std::vector<GraphPicture::Edge>& edges, const MapView& view) {
  std::string d;
  for (const auto& [a, b] : edges) d += svg_stroke(view.at(a), view.at(b));
  return d;
}

/// A way between two times, without the steps that nobody sees.
std::string way(const Trajectory& path, std::int64_t from_utime, std::int64_t to_utime,
                const MapView& view) {
  std::string d;
  std::optional<Eigen::Vector2d> last;
  for (const TimedPose& pose : path) {
    if (pose.utime < from_utime || pose.utime > to_utime) continue;
    const Eigen::Vector2d at = view.at(pose.pose.translation());
    if (last && (at - *last).norm() < kPathStepUnits && pose.utime < path.back().utime) continue;
    d += last ? 'L' : 'M';
    d += svg_point(at);
    last = at;
  }
  return d;
}

}  // namespace

std::string corridors_svg(const CorridorGraph& graph, const MapView& view) {
  std::string parts;
  for (const Corridor& corridor : graph.corridors) {
    std::string d;
    for (const Eigen::Vector2d& p : corridor.points) {
      d += d.empty() ? 'M' : 'L';
      d += svg_point(view.at(p));
    }
    parts += svg_line("corridor", d);
  }
  for (const CorridorNode& node : graph.nodes) {
    if (node.kind == CorridorNode::Kind::kJunction)
      parts += svg_disc("junction", view.at(node.p_map), 3, "junction");
    if (node.kind == CorridorNode::Kind::kDeadEnd)
      parts += svg_disc("dead-end", view.at(node.p_map), 2.5, "dead end");
  }
  return svg_group("layer-corridors", parts);
}

std::string graph_svg(const MissionMap& map, const MapView& view) {
  const GraphPicture graph = graph_picture(map.whole());
  std::string nodes;
  for (const Pose2& node : graph.nodes) nodes += svg_disc("node", view.at(node.translation()), 1.2);
  return svg_group("layer-graph", svg_line("edge", edges(graph.sequential, view)) + nodes +
                                      svg_line("closure", edges(graph.closures, view))) +
         svg_group("layer-revoked", svg_line("revoked", edges(graph.revoked, view)));
}

std::string ways_svg(const Trajectory& path, const std::optional<std::int64_t>& homeward_utime,
                     const MapView& view) {
  if (path.empty()) return "";
  const std::int64_t end = path.back().utime;
  const std::int64_t turn = homeward_utime.value_or(end);
  const std::string home = homeward_utime ? way(path, turn, end, view) : "";
  return svg_group("layer-way", svg_line("out", way(path, path.front().utime, turn, view)) +
                                    svg_line("back", home));
}

std::string start_svg(const Trajectory& path, const MapView& view) {
  if (path.empty()) return "";
  return svg_disc("home", view.at(path.front().pose.translation()), 6.0, "where it started") +
         svg_disc("end", view.at(path.back().pose.translation()), 4.0, "where it stood at last");
}

}  // namespace adit
