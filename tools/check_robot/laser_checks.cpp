// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "common/geometry/pose2.hpp"
#include "tools/check_robot/field_of_view.hpp"
#include "tools/check_robot/robot_check.hpp"

namespace adit {
namespace {

constexpr double kOverhangM = 0.5;          // of a laser beyond the footprint; more is another unit
constexpr double kAssumedBeyondMaxM = 0.5;  // ground that is seen and yet assumed to be even
constexpr double kLeverMaxM = 0.5;          // between the beams and the tilt axis
constexpr double kApartM = 0.1;             // between two lasers
constexpr double kSideM = 0.05;             // from the middle line, of a laser that is not on it
constexpr double kStrayRad = 0.1;  // between both signs of an angle, from which the sign counts
constexpr double kRangeUsefulM = 3.0;

std::string key(const NamedLaser& laser, const char* name) {
  return fmt::format("lasers.{}.{}", laser.name, name);
}

/// Pose and direction of a laser on the body.
void check_pose(const NamedLaser& laser, const Vehicle& vehicle, CheckResults& results) {
  const Pose2& pose = laser.mount.T_body_laser;
  const bool front = laser.name == "front";
  const double out_x = std::abs(pose.x) - 0.5 * vehicle.length_m;
  const double out_y = std::abs(pose.y) - 0.5 * vehicle.width_m;
  add_relation(
      results, std::max(out_x, out_y) <= kOverhangM, "laser",
      fmt::format("{} at ({}, {}) m, the footprint ends at {} and {}", key(laser, "T_body_laser"),
                  pose.x, pose.y, 0.5 * vehicle.length_m, 0.5 * vehicle.width_m),
      "the laser would hang in the air. The origin is the middle of the vehicle, not its "
      "rear axle, and lengths are in metres");
  add_relation(results, std::abs(pose.theta) <= 2.0 * std::numbers::pi, "laser",
               fmt::format("{} = {} is {:.0f}°", key(laser, "T_body_laser.theta_rad"), pose.theta,
                           rad_to_deg(pose.theta)),
               "more than a full turn; degrees instead of radians?");
  const double ahead = std::cos(pose.theta);
  add_relation(results, (front ? ahead : -ahead) > 0.3, "laser",
               fmt::format("{} = {} looks {}", key(laser, "T_body_laser.theta_rad"), pose.theta,
                           ahead > 0.3    ? "forwards"
                           : ahead < -0.3 ? "backwards"
                                          : "to the side"),
               front ? "the front laser looks in the direction of travel, theta_rad about 0"
                     : "the rear laser looks behind, theta_rad about 3.14159");
}

/// What the middle beam of a laser meets first: the own body, or what is before it.
void check_body_in_view(const NamedLaser& laser, const Vehicle& vehicle, CheckResults& results) {
  const LaserMount& mount = laser.mount;
  const double theta = mount.T_body_laser.theta;
  const double inside_m = length_in_body_m(mount, vehicle, theta);
  const double mirrored_m = length_in_body_m(mount, vehicle, -theta);
  const bool has_side =
      std::abs(mount.T_body_laser.y) > kSideM && std::abs(std::sin(theta)) > kStrayRad;
  if (has_side) {
    add_relation(results, inside_m <= mirrored_m + kRoundingM, "laser",
                 fmt::format("{}: the middle beam leaves the body after {:.2f} m, with the other "
                             "sign of theta_rad after {:.2f} m",
                             key(laser, "T_body_laser"), inside_m, mirrored_m),
                 "it looks across the vehicle. Angles are positive to the left: is the sign of "
                 "theta_rad, or that of y_m, wrong?");
  }
  const bool over = looks_over_body(mount, vehicle);
  add_relation(
      results, over || inside_m <= mount.range_min_m + kRoundingM, "laser",
      over ? fmt::format("{} = {} looks over the body, vehicle.height_m = {}",
                         key(laser, "height_m"), mount.height_m, vehicle.height_m)
           : fmt::format("{}: the middle beam leaves the body after {:.2f} m, range_min_m = {}",
                         key(laser, "T_body_laser"), inside_m, mount.range_min_m),
      "the laser is inside the body and sees it as an obstacle. Measure x_m and y_m from the "
      "middle "
      "of the vehicle; only a laser within 12 cm of vehicle.height_m looks over the body");
}

void check_ranges(const NamedLaser& laser, const RobotConfig& robot, CheckResults& results) {
  const LaserMount& mount = laser.mount;
  const Vehicle& vehicle = robot.vehicle;
  add_relation(
      results, mount.height_m > vehicle.step_max_m && mount.height_m < vehicle.height_m, "laser",
      fmt::format("{} = {} between vehicle.step_max_m = {} and vehicle.height_m = {}",
                  key(laser, "height_m"), mount.height_m, vehicle.step_max_m, vehicle.height_m),
      "a level laser below a step or above the vehicle sees no obstacles. height_m is that "
      "of the beams above the ground, in metres; vehicle.height_m includes the laser");
  add_relation(results, mount.height_m > vehicle.wading_depth_max_m, "laser",
               fmt::format("{} = {} above vehicle.wading_depth_max_m = {}", key(laser, "height_m"),
                           mount.height_m, vehicle.wading_depth_max_m),
               "the laser would be under water");
  const double blind_m =
      std::abs(mount.T_body_laser.x) + mount.range_min_m - 0.5 * vehicle.length_m;
  add_relation(
      results, blind_m <= robot.guard.obstacle.margin_m + kRoundingM, "laser",
      fmt::format("{}: |x_m| + range_min_m - vehicle.length_m / 2 = {} + {} - {} = {:.3f} "
                  "against guard.obstacle.margin_m = {}",
                  laser.name, std::abs(mount.T_body_laser.x), mount.range_min_m,
                  0.5 * vehicle.length_m, blind_m, robot.guard.obstacle.margin_m),
      "what is that near before the vehicle is not seen; increase margin_m, or length_m if "
      "the laser protrudes");
  add_relation(results, mount.range_min_m < mount.range_max_m && mount.range_max_m > kRangeUsefulM,
               "laser",
               fmt::format("{} = {} to {} m", key(laser, "range_min_m, range_max_m"),
                           mount.range_min_m, mount.range_max_m),
               "the scans would have no walls; ranges are in metres");
  if (robot.has_sim) {
    const double no_return_m = robot.sim.laser.no_return_m();
    add_relation(
        results, mount.range_max_m < no_return_m, "laser",
        fmt::format("{} = {} below the reading for no return, sim.laser.reading_max unit_m "
                    "= {:.4g}",
                    key(laser, "range_max_m"), mount.range_max_m, no_return_m),
        "readings without a return would be walls");
  }
  add_relation(results,
               std::max(std::abs(mount.lever_x_m), std::abs(mount.lever_z_m)) <= kLeverMaxM,
               "laser",
               fmt::format("{} = {}, {} m", key(laser, "lever_x_m, lever_z_m"), mount.lever_x_m,
                           mount.lever_z_m),
               "from the tilt axis to where the beams begin, in metres: some centimetres");
}

/// The sweep of a tilting laser: which ground it sees nearest to the body.
void check_sweep(const NamedLaser& laser, const RobotConfig& robot, CheckResults& results) {
  const SweepMotionParams& sweep = robot.scan_assembly.sweep;
  const double down = std::max(sweep.from_rad, sweep.to_rad);
  const double up = std::min(sweep.from_rad, sweep.to_rad);
  add_relation(results, down > 0.1 && up < -0.1, "sweep",
               fmt::format("scan_assembly.sweep from {} to {} rad", sweep.from_rad, sweep.to_rad),
               "a sweep sees the ground (positive, down) and the roof (negative, up)");
  if (!(down > 0.0)) return;
  const double blind_m = std::abs(laser.mount.T_body_laser.x) +
                         laser.mount.height_m / std::tan(down) - 0.5 * robot.vehicle.length_m;
  const double assumed_m = robot.planning.c_space.ground.blind_ahead_m;
  add_relation(results, blind_m <= assumed_m, "sweep",
               fmt::format("{}: the steepest beam reaches the ground {:.2f} m before the body, "
                           "planning.c_space.ground.blind_ahead_m = {}",
                           laser.name, blind_m, assumed_m),
               "the ground between is never seen, and no path begins there; sweep farther down, or "
               "increase blind_ahead_m and know that it is assumed to be like the ground under the "
               "robot");
  add_relation(results, assumed_m <= blind_m + kAssumedBeyondMaxM, "sweep",
               fmt::format("{}: planning.c_space.ground.blind_ahead_m = {} <= {:.2f} + {} m",
                           laser.name, assumed_m, blind_m, kAssumedBeyondMaxM),
               "planning assumes ground to be even that the laser sees: a robot that turns on the "
               "spot drives onto rails and over edges there; decrease blind_ahead_m, and "
               "blind_beside_m to what the tail swings out");
}

/// Two lasers: front before rear, and not one of them left out.
void check_pair(const Lasers& lasers, CheckResults& results) {
  if (!lasers.has_rear()) return;
  const Pose2& front = lasers.front.T_body_laser;
  const Pose2& rear = lasers.rear.T_body_laser;
  const double apart_m = (front.translation() - rear.translation()).norm();
  if (apart_m < kApartM || rear == LaserMount{}.T_body_laser || (rear.x == 0.0 && rear.y == 0.0)) {
    add_relation(results, false, "laser", fmt::format("lasers.rear at ({}, {})", rear.x, rear.y),
                 "in the middle of the vehicle, its default. Describe it, or state lasers.count: 1 "
                 "if there is none");
    return;
  }
  add_relation(results, front.x > rear.x, "laser",
               fmt::format("lasers.front.x_m = {} {} lasers.rear.x_m = {}", front.x,
                           front.x > rear.x ? "before" : "behind", rear.x),
               "front and rear are exchanged; x points forwards");
}

}  // namespace

void check_lasers(const RobotConfig& robot, CheckResults& results) {
  add_relation(results, robot.has_lasers, "laser",
               fmt::format("section lasers, {} laser{}", robot.lasers.count,
                           robot.lasers.count == 1 ? "" : "s"),
               "it is missing: the poses of the lasers on this robot are unknown");
  if (!robot.has_lasers) return;
  check_pair(robot.lasers, results);
  for (const NamedLaser& laser : lasers_of(robot.lasers)) {
    check_pose(laser, robot.vehicle, results);
    check_body_in_view(laser, robot.vehicle, results);
    check_ranges(laser, robot, results);
    if (!robot.lasers.lidar.present) check_sweep(laser, robot, results);
  }
  if (robot.lasers.lidar.present) {
    check_lidar(robot, results);
    return;
  }
  add_relation(
      results, robot.scan_matching.lasers_tilt, "sweep",
      fmt::format("scan_matching.lasers_tilt: {}", robot.scan_matching.lasers_tilt),
      "3D scans tilt the laser; without it the scans of a tilted laser count as level until "
      "the first TILT message");
}

}  // namespace adit
