// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/svg/map_layers.hpp"

#include <algorithm>
#include <cmath>

#include "tools/map/map_files.hpp"
#include "tools/report/html/text_format.hpp"
#include "tools/report/svg/svg_elements.hpp"

namespace adit {
namespace {

constexpr double kPathStepUnits = 0.6;  // finer than what is seen

std::string edges(const std::vector<GraphPicture::Edge>& edges, const MapView& view) {
  std::string d;
  for (const auto& [a, b] : edges) d += line_data(view.at(a), view.at(b));
  return d;
}

/// A way between two times, without the steps that nobody sees.
std::string path_data(const Trajectory& path, std::int64_t from_utime, std::int64_t to_utime,
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
    parts += svg_path_element("corridor", d);
  }
  for (const CorridorNode& node : graph.nodes) {
    if (node.kind == CorridorNode::Kind::kJunction)
      parts += svg_circle("junction", view.at(node.p_map), 3, "junction");
    if (node.kind == CorridorNode::Kind::kDeadEnd)
      parts += svg_circle("dead-end", view.at(node.p_map), 2.5, "dead end");
  }
  return svg_group("layer-corridors", parts);
}

std::string graph_svg(const MissionMap& map, const MapView& view) {
  const GraphPicture graph = graph_picture(map.full_map());
  std::string nodes;
  for (const Pose2& node : graph.nodes)
    nodes += svg_circle("node", view.at(node.translation()), 1.2);
  return svg_group("layer-graph",
                   svg_path_element("edge", edges(graph.sequential, view)) + nodes +
                       svg_path_element("closure", edges(graph.loop_closures, view))) +
         svg_group("layer-revoked", svg_path_element("revoked", edges(graph.revoked, view)));
}

std::string paths_svg(const Trajectory& path, const std::optional<std::int64_t>& homeward_utime,
                      const MapView& view) {
  if (path.empty()) return "";
  const std::int64_t end = path.back().utime;
  const std::int64_t turn = homeward_utime.value_or(end);
  const std::string home = homeward_utime ? path_data(path, turn, end, view) : "";
  return svg_group("layer-path",
                   svg_path_element("out", path_data(path, path.front().utime, turn, view)) +
                       svg_path_element("back", home));
}

std::string start_svg(const Trajectory& path, const MapView& view) {
  if (path.empty()) return "";
  return svg_circle("home", view.at(path.front().pose.translation()), 6.0, "where it started") +
         svg_circle("end", view.at(path.back().pose.translation()), 4.0, "where it stood at last");
}

namespace {

constexpr double kAimUnits = 12.0;
constexpr double kRadius = 7.5;
constexpr double kBeside = 16.0;
constexpr int kRowsMax = 4;

std::string css_of(FrontierState state) {
  if (!is_closed(state)) return "open";
  return state == FrontierState::kExplored || state == FrontierState::kOutsideMine ? "done"
                                                                                   : "closed";
}

std::string frontier_svg(const Frontier& frontier, const MapView& view, const std::string& page) {
  const std::string css = css_of(frontier.state);
  const Eigen::Vector2d at = view.at(frontier.p_map);
  const Eigen::Vector2d aim(frontier.direction_map.x(), -frontier.direction_map.y());
  const std::string id = std::to_string(frontier.id);
  const std::string text =
      "Opening " + id + ", " + name_of(frontier.state) + ": " + frontier.evidence;
  const bool done = css == "done";
  return "<a href=\"" + page + "#stub-" + id + "\">" +
         (done ? std::string()
               : svg_path_element("aim " + css, line_data(at, at + kAimUnits * aim))) +
         svg_circle("stub " + css, at, done ? 2.6 : 4.5, text) + "</a>";
}

std::string scan_svg(const ScanMark& scan, const Eigen::Vector2d& place, const Eigen::Vector2d& at,
                     const std::string& page) {
  const std::string number = std::to_string(scan.number);
  const std::string css = scan.found ? "scan" : "scan stuck";
  return "<a class=\"" + css + "\" href=\"" + page + "#scan-" + number + "\"><title>" +
         escaped(scan.text) + "</title>" + svg_path_element("lead", line_data(place, at)) +
         svg_circle("mark", at, kRadius) + "<text x=\"" + fixed(at.x(), 1) + "\" y=\"" +
         fixed(at.y() + 3.0, 1) + "\">" + number + "</text></a>";
}

/// Beside the way, as far from it as it takes not to lie on another.
Eigen::Vector2d free_label_position(const Eigen::Vector2d& place, const Eigen::Vector2d& left,
                                    const std::vector<Eigen::Vector2d>& occupied) {
  const auto is_free = [&](const Eigen::Vector2d& at) {
    return std::none_of(occupied.begin(), occupied.end(), [&](const Eigen::Vector2d& other) {
      return (other - at).norm() < 2.0 * kRadius;
    });
  };
  int row = 1;
  while (row < kRowsMax && !is_free(place + row * kBeside * left)) ++row;
  return place + row * kBeside * left;
}

}  // namespace

const char* name_of(FrontierState state) {
  switch (state) {
    case FrontierState::kOpen:
      return "open";
    case FrontierState::kExplored:
      return "explored";
    case FrontierState::kBlocked:
      return "blocked";
    case FrontierState::kTooNarrow:
      return "too narrow";
    case FrontierState::kBeyondBudget:
      return "too far";
    case FrontierState::kUnobservable:
      return "nothing came back";
    case FrontierState::kOutsideMine:
      return "the way out";
    case FrontierState::kUnconfirmed:
      return "no way found, doubtful";
  }
  return "";
}

std::string frontiers_svg(const std::vector<Frontier>& frontiers, const MapView& view,
                          const std::string& page) {
  std::string parts;
  for (const bool closed : {true, false}) {  // what is open over what is closed
    for (const Frontier& frontier : frontiers) {
      if (is_closed(frontier.state) == closed) parts += frontier_svg(frontier, view, page);
    }
  }
  return svg_group("layer-frontiers", parts);
}

std::string scans_svg(const std::vector<ScanMark>& scans, const MapView& view,
                      const std::string& page) {
  std::vector<Eigen::Vector2d> occupied;
  std::string parts;
  for (const ScanMark& scan : scans) {
    const double heading = scan.T_map_ahead.theta;
    const Eigen::Vector2d place = view.at(scan.T_map_ahead.translation());
    const Eigen::Vector2d left(-std::sin(heading), -std::cos(heading));
    occupied.push_back(free_label_position(place, left, occupied));
    parts += scan_svg(scan, place, occupied.back(), page);
  }
  return svg_group("layer-scans", parts);
}

}  // namespace adit
