// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/check_robot/abilities.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "common/geometry/pose2.hpp"
#include "common/types/body_outline.hpp"
#include "procs/guard/obstacle_check.hpp"
#include "tools/check_robot/field_of_view.hpp"
#include "tools/check_robot/lidar_ground.hpp"

namespace adit {
namespace {

constexpr double kBesideM = 0.3;  // from the body, where blindness is stated

const char* side_of(double bearing_rad) {
  const double c = std::cos(bearing_rad);
  const double s = std::sin(bearing_rad);
  if (std::abs(c) > 0.8) return c > 0.0 ? "ahead" : "behind";
  return s > 0.0 ? "left" : "right";
}

std::string blind_text(const RobotConfig& robot) {
  const auto arcs = blind_arcs(robot.lasers, robot.vehicle, kBesideM);
  if (arcs.empty()) return fmt::format("blind     nowhere, {} m from the body\n", kBesideM);
  std::string text;
  for (const BlindArc& arc : arcs) {
    text += fmt::format("blind     {}: {} m from the body, from {:.0f}° to {:.0f}° of its middle\n",
                        side_of(arc.middle_rad()), kBesideM, rad_to_deg(arc.from_rad),
                        rad_to_deg(arc.to_rad));
  }
  if (!robot.lasers.sees_behind()) {
    text +=
        "blind     no rear laser: it turns round by driving, and reverses only over ground that "
        "it saw or came over; what comes there afterwards it does not see\n";
  }
  return text;
}

/// The ground that a spinning lidar shows while the robot stands, from the lidar.
std::string ground_text(const RobotConfig& robot) {
  std::string text;
  for (const auto& [name, bearing_deg] :
       {std::pair("ahead", 0.0), std::pair("45° to a side", 45.0), std::pair("to a side", 90.0),
        std::pair("behind", 180.0)}) {
    const double bearing_rad = bearing_deg * std::numbers::pi / 180.0;
    const auto ground =
        lidar_ground(robot.lasers, robot.sim.lidar, bearing_rad, robot.terrain.unseen.gap_max_m);
    const bool is_seen = ground && ground->to_m > ground->from_m;
    text += is_seen ? fmt::format(
                          "ground    {}: seen from {:.1f} to {:.1f} m from the lidar, if it "
                          "is level\n",
                          name, ground->from_m, ground->to_m)
                    : fmt::format("ground    {}: not seen\n", name);
  }
  return text;
}

}  // namespace

Abilities abilities_of(const RobotConfig& robot) {
  const Vehicle& vehicle = robot.vehicle;
  const GroundLimits& ground = robot.planning.c_space.ground;
  const ObstacleParams& obstacle = robot.guard.obstacle;
  const LaserMount& laser = robot.lasers.front;
  Abilities abilities;
  abilities.width_min_m = vehicle.width_m + 2.0 * robot.planning.passage.clearance_min_m;
  abilities.width_full_m = vehicle.width_m + 2.0 * robot.driving.speed.clearance_full_m;
  abilities.height_min_m = vehicle.height_m + ground.roof_margin_m;
  abilities.step_max_m = std::max(0.0, vehicle.step_max_m - ground.step_margin_m);
  abilities.bump_max_m = std::max(0.0, vehicle.belly_clearance_m - ground.belly_margin_m);
  abilities.slope_max_rad = ground.slope_max_rad;
  const double radius = vehicle.turning_radius_m * (1.0 + robot.planning.primitives.radius_reserve);
  // The corners of the body on the outer side of the turn, about its centre beside the body.
  for (const Eigen::Vector2d& corner : body_outline(vehicle).corners()) {
    abilities.turn_width_m =
        std::max(abilities.turn_width_m, 2.0 * std::hypot(radius + corner.y(), corner.x()));
  }
  const double step_rad = laser.field_of_view_rad / std::max(1, robot.sim.laser.beams - 1);
  abilities.scan_period_s = laser.timing.scan_period_s(step_rad);
  const auto stopping_m = [&](double speed) {
    return stopping_distance_m(obstacle, speed, abilities.scan_period_s) + obstacle.margin_m;
  };
  abilities.stopping_m = stopping_m(robot.driving.speed.speed_m_s);
  abilities.stopping_creep_m = stopping_m(robot.driving.speed.creep_m_s);
  return abilities;
}

std::string text_of_abilities(const RobotConfig& robot) {
  const Abilities can = abilities_of(robot);
  const Vehicle& vehicle = robot.vehicle;
  const ObstacleParams& obstacle = robot.guard.obstacle;
  const double speed = robot.driving.speed.speed_m_s;
  std::string text;
  text += fmt::format("passes    width {:.2f} m creeping ({} + 2 x {}), {:.2f} m at full speed\n",
                      can.width_min_m, vehicle.width_m, robot.planning.passage.clearance_min_m,
                      can.width_full_m);
  text += fmt::format("passes    height {:.2f} m ({} + {})\n", can.height_min_m, vehicle.height_m,
                      robot.planning.c_space.ground.roof_margin_m);
  text += fmt::format(
      "passes    steps of {:.2f} m under the wheels, of {:.2f} m between them, slopes "
      "of {:.0f}°\n",
      can.step_max_m, can.bump_max_m, rad_to_deg(can.slope_max_rad));
  text += fmt::format(
      "turns     in a circle of {:.2f} m, at turning_radius_m = {} with a reserve of "
      "{:.0f} %; in less by moving forwards and backwards\n",
      can.turn_width_m, vehicle.turning_radius_m, 100.0 * robot.planning.primitives.radius_reserve);
  text += fmt::format(
      "stops     within {:.2f} m at {} m/s: {} x ({} reaction + {:.3f} scan) + {}² / "
      "(2 x {}) + {} margin; within {:.2f} m at {} m/s\n",
      can.stopping_m, speed, speed, obstacle.reaction_s, can.scan_period_s, speed,
      obstacle.braking_m_s2, obstacle.margin_m, can.stopping_creep_m,
      robot.driving.speed.creep_m_s);
  for (const NamedLaser& laser : lasers_of(robot.lasers)) {
    text += fmt::format("sees      {}: {:.0f}° from {} to {} m, {} x the stopping distance\n",
                        laser.name, rad_to_deg(laser.mount.field_of_view_rad),
                        laser.mount.range_min_m, laser.mount.range_max_m,
                        static_cast<int>(laser.mount.range_max_m / can.stopping_m));
  }
  if (robot.lasers.lidar.present) text += ground_text(robot);
  return text + blind_text(robot);
}

}  // namespace adit
