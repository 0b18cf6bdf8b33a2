// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/sensing/motion_correction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "common/geometry/pose2.hpp"

namespace adit {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kHalfWidthM = 1.5;
constexpr double kEndM = 6.0;

LaserMount lidar_mount(bool clockwise) {
  LaserMount mount;
  mount.T_body_laser = {0.3, 0.0, 0.0};
  mount.range_max_m = 100.0;
  mount.field_of_view_rad = kTurn;
  mount.timing = {.mirror_hz = 10.0, .mirror_turns = 1, .clockwise = clockwise};
  return mount;
}

/// Range of a ray in a tunnel along x with ends at ±kEndM.
double range_in_tunnel_m(const Pose2& T_world_laser, double bearing_rad) {
  const double angle = T_world_laser.theta + bearing_rad;
  const double dx = std::cos(angle);
  const double dy = std::sin(angle);
  const double along = ((dx > 0.0 ? kEndM : -kEndM) - T_world_laser.x) / dx;
  const double across = ((dy > 0.0 ? kHalfWidthM : -kHalfWidthM) - T_world_laser.y) / dy;
  return std::min(along, across);
}

/// What a laser of 720 beams measures that moves with the body.
LaserScan scan_in_tunnel(const LaserMount& mount, const Eigen::Vector3d& velocity) {
  LaserScan scan;
  scan.angle_step_rad = kTurn / 720.0;
  scan.angle_min_rad = -std::numbers::pi + scan.angle_step_rad / 2.0;
  for (int beam = 0; beam < 720; ++beam) {
    const double t = mount.timing.beam_time_s(beam, 720, scan.angle_step_rad);
    const Pose2 T_world_body{t * velocity.x(), t * velocity.y(), t * velocity.z()};
    scan.ranges_m.push_back(static_cast<float>(range_in_tunnel_m(
        T_world_body * mount.T_body_laser, scan.angle_min_rad + beam * scan.angle_step_rad)));
  }
  return scan;
}

/// Largest distance of the ends of the beams from the walls of the tunnel, beside its corners.
double off_walls_m(const LaserScan& scan, const LaserMount& mount) {
  double worst_m = 0.0;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double bearing = scan.angle_min_rad + static_cast<double>(i) * scan.angle_step_rad;
    const double range_m = scan.ranges_m[i];
    if (!std::isfinite(range_m)) continue;
    const Eigen::Vector2d p = mount.T_body_laser * Eigen::Vector2d(range_m * std::cos(bearing),
                                                                   range_m * std::sin(bearing));
    const double wall_m = std::abs(std::abs(p.y()) - kHalfWidthM);
    const double end_m = std::abs(std::abs(p.x()) - kEndM);
    const bool is_corner = wall_m < 0.1 && end_m < 0.1;
    if (!is_corner) worst_m = std::max(worst_m, std::min(wall_m, end_m));
  }
  return worst_m;
}

TEST(MotionCorrection, PutsTheEndsOfAllBeamsOnTheWalls) {
  for (const bool clockwise : {false, true}) {
    const LaserMount mount = lidar_mount(clockwise);
    for (const Eigen::Vector3d& velocity :
         {Eigen::Vector3d(0.5, 0.0, 0.0), Eigen::Vector3d(0.0, 0.0, 0.6),
          Eigen::Vector3d(-0.3, 0.05, -0.4)}) {
      const LaserScan moved = scan_in_tunnel(mount, velocity);
      EXPECT_GT(off_walls_m(moved, mount), 0.02);
      const StillScan still = without_motion(moved, mount, velocity);
      EXPECT_LT(off_walls_m(still.scan, mount), 0.004) << velocity.transpose();
      EXPECT_EQ(still.scan.ranges_m.size(), moved.ranges_m.size());
      const auto unknown = std::ranges::count(still.beam_of, -1);
      EXPECT_LE(unknown, 8);  // beside the seam
    }
  }
}

TEST(MotionCorrection, SaysWhichMeasuredBeamEachShows) {
  const LaserMount mount = lidar_mount(true);
  const Eigen::Vector3d velocity(0.0, 0.0, 0.5);
  const StillScan still = without_motion(scan_in_tunnel(mount, velocity), mount, velocity);
  // The beam straight ahead is measured after half a turn of 0.1 s, in which the body turns 25
  // mrad.
  EXPECT_NEAR(still.measured_beam(360), 360 - 0.025 / (kTurn / 720.0), 1.0);
}

TEST(MotionCorrection, TurnsBeamsWithoutReturn) {
  const LaserMount mount = lidar_mount(false);
  const Eigen::Vector3d velocity(0.0, 0.0, 0.5);
  LaserScan scan = scan_in_tunnel(mount, velocity);
  scan.ranges_m[300] = std::numeric_limits<float>::infinity();
  const StillScan still = without_motion(scan, mount, velocity);
  const auto infinite = [](float range_m) { return std::isinf(range_m); };
  const auto found = std::ranges::find_if(still.scan.ranges_m, infinite);
  ASSERT_NE(found, still.scan.ranges_m.end());
  const double turned = 0.5 * mount.timing.beam_time_s(300, 720, scan.angle_step_rad);
  EXPECT_NEAR(static_cast<double>(found - still.scan.ranges_m.begin()),
              300 + turned / scan.angle_step_rad, 1.0);
}

TEST(MotionCorrection, LeavesShortScansAndStandingBodiesAlone) {
  LaserMount sick;
  LaserScan scan;
  scan.angle_step_rad = std::numbers::pi / 180.0;
  scan.ranges_m.assign(181, 5.0F);
  EXPECT_TRUE(without_motion(scan, sick, {0.5, 0.0, 0.3}).beam_of.empty());
  const LaserMount mount = lidar_mount(true);
  const StillScan still = without_motion(scan_in_tunnel(mount, {0.0, 0.0, 0.0}), mount, {0, 0, 0});
  EXPECT_TRUE(still.beam_of.empty());
  EXPECT_EQ(still.measured_beam(7), 7);
}

}  // namespace
}  // namespace adit
