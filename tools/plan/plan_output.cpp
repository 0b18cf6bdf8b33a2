// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/plan/plan_output.hpp"

#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/files/file_utils.hpp"
#include "common/picture/cloud_picture.hpp"
#include "common/picture/terrain_picture.hpp"
#include "procs/planning/planning_picture.hpp"

namespace adit {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSlices = 8;  // over half a turn; the footprint is symmetric
constexpr int kScanWidth = 708;
constexpr int kScanHeight = 400;

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
  if (plan.goal.kind == PlanGoal::Kind::kToPose) return pose(T_level_goal);
  if (!plan.goal.route_odom.empty()) {
    const Pose2 T_level_odom = plan.terrain.T_odom_level.inverse();
    Json route = Json::array();
    for (const Eigen::Vector2d& p_odom : plan.goal.route_odom) {
      const Eigen::Vector2d p_level = T_level_odom * p_odom;
      route.push_back({{"x_m", p_level.x()}, {"y_m", p_level.y()}});
    }
    return {{"route", route}};
  }
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
  const auto& [measured, never_scanned, shadow, below_ray, no_return] = plan.ground;
  return {{"measured", measured},
          {"never_scanned", never_scanned},
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

/// The plan as JSON, in level: outcome and reason, figures, goal, path points, blocking cells,
/// number of ground cells by observation state, computation times. Infinite values are null.
std::string path_json(const Cloud& cloud, const ScanPlan& plan) {
  const Json json{
      {"frame", "level: origin on the ground below the robot, x forward, y left"},
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

std::string laser_of(const Cloud& cloud) {
  if (cloud.lines.empty()) return "";
  const Eigen::Vector3f& p = cloud.lines.front().origin;
  return fmt::format("; laser at {:.2f}, {:.2f}, {:.2f} m", p.x(), p.y(), p.z());
}

std::vector<double> slice_angles() {
  std::vector<double> angles;
  for (int i = 0; i < kSlices; ++i) angles.push_back(i * std::numbers::pi / kSlices);
  return angles;
}

}  // namespace

std::vector<std::string> plan_summary(const Cloud& cloud, const ScanPlan& plan) {
  const auto& [measured, never_scanned, shadow, below_ray, no_return] = plan.ground;
  const PlannedPath& path = plan.path;
  std::vector<std::string> summary{
      fmt::format("{} points{}{}", cloud.points(), cloud.complete ? "" : ", incomplete",
                  laser_of(cloud)),
      fmt::format("{} cells: {} measured, {} not scanned, {} in shadow, {} below a beam, "
                  "{} without return",
                  plan.terrain.cells.size(), measured, never_scanned, shadow, below_ray, no_return),
      fmt::format("{}: {}", name_of(path.outcome), path.reason)};
  if (path.points.empty()) {
    summary.push_back(fmt::format("{} cells block the path", path.blocking.size()));
  } else {
    summary.push_back(
        fmt::format("path length {:.1f} m, progress to the goal {:.1f} m, least clearance {:.2f} m",
                    path_length_m(path), path.reached_m, least_clearance_m(path)));
  }
  return summary;
}

std::string plan_times(const ScanPlan::Times& times) {
  return fmt::format(
      "terrain {:.1f} ms, C-space {:.1f} ms, search {:.1f} ms: scan to path {:.1f} ms "
      "(kernels, once: {:.1f} ms)",
      times.terrain_ms, times.c_space_ms, times.search_ms, times.scan_to_path_ms(),
      times.kernels_ms);
}

void write_plan_files(const std::string& title, const Cloud& cloud, const ScanPlan& plan,
                      const Planning& planning, const Vehicle& vehicle,
                      const std::filesystem::path& folder) {
  PlanPicture picture =
      planning_picture(title, plan.terrain, plan.path, planning, vehicle, slice_angles());
  picture.goal = plan.goal;
  picture.facts = plan_summary(cloud, plan);
  picture.scan = cloud_image(cloud, kScanWidth, kScanHeight);
  write_terrain_png(plan.terrain, folder / "terrain.png");
  write_terrain_png(plan.terrain, folder / "clearance.png", TerrainLayer::kClearance);
  write_terrain_png(plan.terrain, folder / "unknown.png", TerrainLayer::kKnowledge);
  write_slices_png(picture, folder / "c_space.png");
  write_kernels_png(picture, folder / "kernels.png");
  write_path_png(picture, folder / "plan.png");
  write_plan_png(picture, folder / "sheet.png");
  write_text_file(path_json(cloud, plan), folder / "path.json");
}

}  // namespace adit
