// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/terrain_overlay.hpp"

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "tools/report/svg_parts.hpp"
#include "tools/report/text.hpp"

namespace adit {
namespace {

constexpr double kOutlineEveryM = 1.5;

/// As far as the robot is to get: along a line, along a route, or a place.
std::vector<Eigen::Vector2d> way_to(const CellView& view, const PlanGoal& goal) {
  const Pose2 T_level_odom = view.terrain().T_odom_level.inverse();
  std::vector<Eigen::Vector2d> way;
  for (const Eigen::Vector2d& p_odom : goal.route_odom)
    way.push_back(view.at(T_level_odom * p_odom));
  if (!way.empty()) return way;
  const Pose2 T_level_goal = T_level_odom * goal.T_odom_goal;
  way.push_back(view.at(T_level_goal.translation()));
  if (goal.kind == PlanGoal::Kind::kAlong) {
    way.push_back(view.at(T_level_goal * Eigen::Vector2d(goal.distance_m, 0.0)));
  }
  return way;
}

}  // namespace

std::string svg_outline(const CellView& view, const Pose2& T_level_body, const Vehicle& vehicle,
                        const char* css_class) {
  const double x = vehicle.length_m / 2.0;
  const double y = vehicle.width_m / 2.0;
  std::string points;
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(-x, -y), Eigen::Vector2d(x, -y),
                                        Eigen::Vector2d(x, y), Eigen::Vector2d(-x, y)}) {
    points += svg_point(view.at(T_level_body * corner)) + " ";
  }
  points.pop_back();
  return std::string("<polygon class=\"") + css_class + "\" points=\"" + points + "\"/>";
}

std::string svg_path(const CellView& view, const PlannedPath& path, const Vehicle& vehicle) {
  std::string outlines;
  std::string line;
  double way = kOutlineEveryM;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const Pose2& T_odom_body = path.points[i].T_odom_body;
    line += svg_point(view.at(T_odom_body)) + " ";
    if (i > 0) way += between(path.points[i - 1].T_odom_body, T_odom_body).translation().norm();
    if (way < kOutlineEveryM && i + 1 < path.points.size()) continue;
    way = 0.0;
    outlines +=
        svg_outline(view, between(view.terrain().T_odom_level, T_odom_body), vehicle, "step");
  }
  if (line.empty()) return "";
  line.pop_back();
  return outlines + "<polyline class=\"way\" points=\"" + line + "\"/>";
}

/// Cells side by side are one stroke, so that a page does not grow with them.
std::string svg_blocking(const CellView& view, const PlannedPath& path) {
  std::map<BlockingCell::Reason, std::set<std::pair<int, int>>> cells;  // row, column
  for (const BlockingCell& cell : path.blocking) {
    const Eigen::Vector2d p_level = view.terrain().T_odom_level.inverse() * cell.p_odom;
    const Eigen::Vector2d at = view.at(p_level);
    cells[cell.reason].insert(
        {static_cast<int>(std::floor(at.y())), static_cast<int>(std::floor(at.x()))});
  }
  std::string text;
  for (const auto& [reason, places] : cells) {
    const BlockingName& name = blocking_name(reason);
    text += std::string("<path class=\"") + name.css_class + "\" d=\"";
    for (auto at = places.begin(); at != places.end();) {
      const auto [row, first] = *at;
      int end = first;
      while (at != places.end() && at->first == row && at->second == end) ++at, ++end;
      text += 'M' + std::to_string(first) + ' ' + fixed(row + 0.5, 1) + 'h' +
              std::to_string(end - first);
    }
    text += "\"><title>" + std::string(name.name) + "</title></path>";
  }
  return text;
}

std::string svg_goal(const CellView& view, const PlanGoal& goal) {
  const std::vector<Eigen::Vector2d> way = way_to(view, goal);
  std::string line;
  for (const Eigen::Vector2d& place : way) {
    line += line.empty() ? 'M' : 'L';
    line += svg_point(place);
  }
  return "<path class=\"goal\" d=\"" + line + "\"/><circle class=\"goal\" cx=\"" +
         fixed(way.back().x(), 1) + "\" cy=\"" + fixed(way.back().y(), 1) + "\" r=\"3\"/>";
}

const BlockingName& blocking_name(BlockingCell::Reason reason) {
  static constexpr std::array<BlockingName, 7> kNames{{{"b0", "a step"},
                                                       {"b1", "too high to drive over"},
                                                       {"b2", "the roof"},
                                                       {"b3", "not seen"},
                                                       {"b4", "perhaps water"},
                                                       {"b5", "too steep"},
                                                       {"b6", "a drop"}}};
  return kNames.at(static_cast<std::size_t>(reason));
}

}  // namespace adit
