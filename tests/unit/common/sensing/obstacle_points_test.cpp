// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/sensing/obstacle_points.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace adit {
namespace {

const Eigen::Vector3d kLevel = Eigen::Vector3d::UnitZ();
constexpr ObstacleHeights kHeights{.min_m = 0.2, .max_m = 1.0};
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

LaserMount mount() {
  LaserMount mount;
  mount.T_body_laser = {1.05, 0.0, 0.0};
  mount.height_m = 0.62;
  mount.range_min_m = 0.2;
  return mount;
}

LaserScan scan_ahead(std::vector<float> ranges_m) {
  const double half = 0.5 * static_cast<double>(ranges_m.size() - 1);
  return {1, std::move(ranges_m), -half * 0.01, 0.01};
}

int obstacles(const LaserPoints& points) {
  int n = 0;
  for (const Eigen::Vector2d& p : points.p_body) n += std::isnan(p.x()) ? 0 : 1;
  return n;
}

int obstacles_at(float range_m, double tilt_rad, const Eigen::Vector3d& up_body = kLevel) {
  return obstacles(project_scan(scan_ahead({range_m}), mount(), tilt_rad, up_body, kHeights));
}

TEST(LaserPoints, AreInTheBodyFrame) {
  const LaserPoints points =
      project_scan(scan_ahead({2.0F, 1.0F, 2.0F}), mount(), 0.0, kLevel, kHeights);
  ASSERT_EQ(points.p_body.size(), 3U);
  EXPECT_NEAR(points.p_body[1].x(), 2.05, 1e-6);
  EXPECT_NEAR(points.p_body[1].y(), 0.0, 1e-6);
  EXPECT_NEAR(points.p_body[2].y(), 2.0 * std::sin(0.01), 1e-6);
}

TEST(LaserPoints, LeaveOutInvalidRanges) {
  const float infinite = std::numeric_limits<float>::infinity();
  const LaserPoints points =
      project_scan(scan_ahead({kNan, infinite, -1.0F, 0.0F, 0.1F, 50.0F, 81.91F}), mount(), 0.0,
                   kLevel, kHeights);
  EXPECT_EQ(points.returns, 0);
  EXPECT_EQ(obstacles(points), 0);
  EXPECT_EQ(project_scan({}, mount(), 0.0, kLevel, kHeights).p_body.size(), 0U);
}

TEST(LaserPoints, LeaveOutGroundAndRoof) {
  const double down = 0.5;
  const auto floor_m = static_cast<float>(0.62 / std::sin(down));
  EXPECT_EQ(obstacles_at(floor_m, down), 0);
  EXPECT_EQ(obstacles_at(0.5F * floor_m, down), 1);  // 0.31 m above the floor
  EXPECT_EQ(obstacles_at(3.0F, -down), 0);           // 2 m high
  EXPECT_EQ(obstacles_at(0.5F, -down), 1);           // 0.86 m high; the vehicle is 1 m high
}

/// The laser is 0.62 m above the ground; obstacles are from 0.2 to 1 m high.
TEST(LaserPoints, ShowFreeSpaceUpToWhereABeamLeavesTheHeightsOfObstacles) {
  const auto free_m = [](float range_m, double tilt_rad, const Eigen::Vector3d& up_body = kLevel) {
    const LaserPoints points =
        project_scan(scan_ahead({range_m}), mount(), tilt_rad, up_body, kHeights);
    return points.p_body_free.at(0).x() - mount().T_body_laser.x;
  };
  EXPECT_NEAR(free_m(3.0F, 0.0), 3.0, 1e-6);                         // an obstacle
  EXPECT_NEAR(free_m(6.0F, 0.1), 0.42 / std::tan(0.1), 1e-6);        // towards the ground
  EXPECT_NEAR(free_m(6.0F, -0.1), 0.38 / std::tan(0.1), 1e-6);       // towards the roof
  EXPECT_NEAR(free_m(2.0F, -0.1), 2.0 * std::cos(0.1), 1e-6);        // ends before
  const Eigen::Vector3d pitched(std::sin(0.1), 0.0, std::cos(0.1));  // nose up
  const double height_m =
      0.62 * std::cos(0.1) + 1.05 * std::sin(0.1);  // of the laser along gravity
  EXPECT_NEAR(free_m(6.0F, 0.0, pitched), (1.0 - height_m) / std::sin(0.1), 1e-6);
  EXPECT_TRUE(std::isnan(free_m(kNan, 0.0)));
}

TEST(LaserPoints, ContainAWallAheadOfAPitchedBody) {
  // Nose up by 0.07 rad, as with the front wheels on a rail: the beam rises.
  const Eigen::Vector3d nose_up(std::sin(0.07), 0.0, std::cos(0.07));
  EXPECT_EQ(obstacles_at(1.0F, 0.0, nose_up), 1);
  // Floor ahead of a body with its nose down: above the plane of its wheels, but not by gravity.
  const Eigen::Vector3d nose_down(-std::sin(0.2), 0.0, std::cos(0.2));
  EXPECT_EQ(obstacles_at(2.0F, 0.0, nose_down), 0);
}

}  // namespace
}  // namespace adit
