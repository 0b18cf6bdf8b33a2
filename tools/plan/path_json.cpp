// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/plan/path_json.hpp"

#include <nlohmann/json.hpp>

namespace adit {
namespace {

using Json = nlohmann::ordered_json;

const char* name_of(BlockingCell::Reason reason) {
  switch (reason) {
    case BlockingCell::Reason::kStep:
      return "step";
    case BlockingCell::Reason::kBelly:
      return "belly";
    case BlockingCell::Reason::kRoof:
      return "roof";
    case BlockingCell::Reason::kUnknown:
      return "unknown";
    case BlockingCell::Reason::kWater:
      return "water";
    case BlockingCell::Reason::kSlope:
      return "slope";
    case BlockingCell::Reason::kDrop:
      return "drop";
  }
  return "";
}

Json pose(const Pose2& T_level) {
  return {{"x_m", T_level.x}, {"y_m", T_level.y}, {"heading_rad", T_level.theta}};
}

Json goal_of(const ScanPlan& plan) {
  const Pose2 T_level_goal = between(plan.terrain.T_odom_level, plan.goal.T_odom_goal);
  if (plan.goal.kind == PlanGoal::Kind::kTo) return pose(T_level_goal);
  return {{"along_rad", T_level_goal.theta}, {"distance_m", plan.goal.distance_m}};
}

Json points_of(const ScanPlan& plan) {
  Json points = Json::array();
  for (const PathPoint& point : plan.path.points) {
    Json json = pose(between(plan.terrain.T_odom_level, point.T_odom_body));
    json["curvature_1_m"] = point.curvature_1_m;
    json["reverse"] = point.reverse;
    json["clearance_m"] = point.clearance_m;
    json["cost"] = point.cost;
    points.push_back(std::move(json));
  }
  return points;
}

Json blocking_of(const ScanPlan& plan) {
  const Pose2 T_level_odom = plan.terrain.T_odom_level.inverse();
  Json cells = Json::array();
  for (const BlockingCell& cell : plan.path.blocking) {
    const Eigen::Vector2d p_level = T_level_odom * cell.p_odom;
    cells.push_back({{"x_m", p_level.x()},
                     {"y_m", p_level.y()},
                     {"reason", name_of(cell.reason)},
                     {"height_m", cell.height_m}});
  }
  return cells;
}

Json ground_of(const ScanPlan& plan) {
  const auto& [seen, never_seen, shadow, below_ray, no_return] = plan.ground;
  return {{"seen", seen},
          {"never_seen", never_seen},
          {"shadow", shadow},
          {"below_ray", below_ray},
          {"no_return", no_return}};
}

Json times_of(const ScanPlan::Times& times) {
  return {{"terrain", times.terrain_ms},
          {"c_space", times.c_space_ms},
          {"search", times.search_ms},
          {"scan_to_path", times.scan_to_path_ms()},
          {"kernels_once", times.kernels_ms}};
}

}  // namespace

std::string path_json(const Cloud& cloud, const ScanPlan& plan) {
  const Json json{
      {"frame", "level: origin on the ground below the robot, x ahead, y to the left"},
      {"scan", {{"id", cloud.id}, {"points", cloud.points()}, {"complete", cloud.complete}}},
      {"goal", goal_of(plan)},
      {"outcome", name_of(plan.path.outcome)},
      {"reason", plan.path.reason},
      {"reached_m", plan.path.reached_m},
      {"length_m", path_length_m(plan.path)},
      {"least_clearance_m", least_clearance_m(plan.path)},
      {"cost", plan.path.points.empty() ? 0.0 : plan.path.points.back().cost},
      {"points", points_of(plan)},
      {"blocking", blocking_of(plan)},
      {"ground_cells", ground_of(plan)},
      {"times_ms", times_of(plan.times)}};
  return json.dump(2) + "\n";
}

}  // namespace adit
