// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/drive/waypoint_driver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/worlds/box_tunnel.hpp"

namespace adit {
namespace {

using testing::HasSubstr;

constexpr double kStepS = 0.01;

/// A hall of 60 m by 60 m, centred on the origin.
World hall() { return box_tunnel({60.0, 60.0, 2.0}); }

/// Result of a drive.
struct Drive {
  double off_line_max_m = 0.0;  ///< greatest distance from a given line
  double seconds = 0.0;
  double speed_min_m_s = std::numeric_limits<double>::infinity();
  double speed_max_m_s = -std::numeric_limits<double>::infinity();
};

Drive drive(WaypointDriver& driver, VehicleModel& vehicle, const WaypointPath& line,
            double seconds_max) {
  Drive drive;
  while (!driver.done() && !driver.abort_reason() && !vehicle.failure() &&
         drive.seconds < seconds_max) {
    vehicle.command(driver.command(vehicle.motion()));
    vehicle.advance(kStepS);
    const Eigen::Vector2d p = vehicle.motion().T_world_body.translation().head<2>();
    const double nearest_m = line.nearest_m(p, 0.0, line.length_m());
    drive.off_line_max_m = std::max(drive.off_line_max_m, (line.at(nearest_m) - p).norm());
    drive.seconds += kStepS;
    drive.speed_min_m_s = std::min(drive.speed_min_m_s, vehicle.state().speed_m_s);
    drive.speed_max_m_s = std::max(drive.speed_max_m_s, vehicle.state().speed_m_s);
  }
  return drive;
}

std::vector<Waypoint> waypoints(const std::vector<Eigen::Vector2d>& points) {
  std::vector<Waypoint> waypoints;
  for (const Eigen::Vector2d& point : points) waypoints.push_back({point, std::nullopt});
  return waypoints;
}

/// One period of a sine of 2 m over 20 m: radius at least 5 m.
std::vector<Eigen::Vector2d> s_curve() {
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i <= 40; ++i) {
    const double x = 0.5 * i;
    points.emplace_back(x, 1.0 - std::cos(2.0 * std::numbers::pi * x / 20.0));
  }
  return points;
}

Eigen::Vector2d place(const VehicleModel& vehicle) {
  return vehicle.motion().T_world_body.translation().head<2>();
}

class WaypointDriverOf : public testing::TestWithParam<const char*> {};

TEST_P(WaypointDriverOf, FollowsACurveAndStopsAtTheEnd) {
  const Site site(hall());
  Vehicle shape;
  shape.steering = GetParam();
  VehicleModel vehicle(site, shape, {}, 3, 0);  // with slip, ahead and to the side
  WaypointDriver driver(waypoints(s_curve()), shape);
  const Drive drive_of = drive(driver, vehicle, WaypointPath(s_curve()), 200.0);

  EXPECT_TRUE(driver.done()) << driver.abort_reason().value_or("")
                             << vehicle.failure().value_or("");
  EXPECT_LT(drive_of.off_line_max_m, 0.15);
  EXPECT_NEAR(driver.progress_m(), driver.length_m(), 0.05);  // arrival_m
  for (int i = 0; i < 100; ++i) {
    vehicle.command(driver.command(vehicle.motion()));
    vehicle.advance(kStepS);
  }
  EXPECT_EQ(vehicle.state().speed_m_s, 0.0);
  EXPECT_LT((place(vehicle) - s_curve().back()).norm(), 0.15);
}

/// Two tunnels of 3 m that meet at (8, 0), at a right angle to the left.
World corner_of_tunnels() {
  return box_tunnel({60.0, 60.0, 2.0}, [](MeshBuilder& builder) {
    builder.begin_part(PartKind::kWall, Material::kRock, "inner_rib");
    builder.box(level_box({1.5, 6.5, 1.0}, {10.0, 10.0, 2.0}));
    builder.begin_part(PartKind::kWall, Material::kRock, "outer_ribs");
    builder.box(level_box({5.0, -2.0, 1.0}, {16.0, 1.0, 2.0}));
    builder.box(level_box({10.0, 5.0, 1.0}, {1.0, 14.0, 2.0}));
  });
}

TEST_P(WaypointDriverOf, TakesACornerOfTunnelsThreeMetresWide) {
  const Site site(corner_of_tunnels());
  Vehicle shape;
  shape.steering = GetParam();
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    VehicleModel vehicle(site, shape, {}, seed, 0);
    WaypointDriver driver(waypoints({{8.0, 0.0}, {8.0, 10.0}}), shape);
    drive(driver, vehicle, WaypointPath({{0.0, 0.0}, {8.0, 0.0}, {8.0, 10.0}}), 200.0);
    EXPECT_TRUE(driver.done()) << vehicle.failure().value_or("");
  }
}

INSTANTIATE_TEST_SUITE_P(Steerings, WaypointDriverOf, testing::Values("four_wheel", "ackermann"));

TEST(WaypointDriver, SlowsDownInABendAndKeepsTheSpeedOfALeg) {
  const Site site(hall());
  VehicleModel vehicle(site, {}, {}, 1, 0);
  std::vector<Waypoint> corner = waypoints({{8.0, 0.0}, {8.0, 8.0}});
  corner[1].speed_m_s = 0.25;
  WaypointDriver driver(corner, {});
  double in_corner = 1.0;
  double on_second_leg = 0.0;
  while (!driver.done() && !vehicle.failure()) {
    vehicle.command(driver.command(vehicle.motion()));
    vehicle.advance(kStepS);
    const Eigen::Vector2d p = place(vehicle);
    if ((p - Eigen::Vector2d(8.0, 0.0)).norm() < 0.6) {
      in_corner = std::min(in_corner, vehicle.state().speed_m_s);
    }
    if (p.y() > 2.0) on_second_leg = std::max(on_second_leg, vehicle.state().speed_m_s);
  }
  EXPECT_LT(in_corner, 0.4 * 0.4 + 0.02);  // slow_share of the speed, and one step of planning
  EXPECT_NEAR(on_second_leg, 0.25, 1e-9);
}

TEST(WaypointDriver, DrivesACrossingInOrder) {
  const Site site(hall());
  VehicleModel vehicle(site, {}, {}, 1, 0);
  const std::vector<Eigen::Vector2d> eight{{10.0, 0.0}, {10.0, 8.0}, {5.0, 8.0}, {5.0, -8.0}};
  WaypointDriver driver(waypoints(eight), {});
  const Drive drive_of = drive(
      driver, vehicle, WaypointPath({{0.0, 0.0}, eight[0], eight[1], eight[2], eight[3]}), 300.0);
  EXPECT_TRUE(driver.done()) << driver.abort_reason().value_or("");
  EXPECT_NEAR(vehicle.distance_travelled_m(), driver.length_m(),
              3.0);                          // less what three corners save
  EXPECT_LT(drive_of.off_line_max_m, 0.75);  // half of the look-ahead
}

TEST(WaypointDriver, ReversesToWaypointsBehindIfAllowed) {
  const Site site(hall());
  VehicleModel vehicle(site, {}, {}, 1, 0);
  const std::vector<Eigen::Vector2d> back{{6.0, 0.0}, {-4.0, 1.0}};
  WaypointDriverParams params;
  params.reverse = true;
  WaypointDriver driver(waypoints(back), {}, params);
  const Drive drive_of =
      drive(driver, vehicle, WaypointPath({{0.0, 0.0}, back[0], back[1]}), 200.0);
  EXPECT_TRUE(driver.done()) << driver.abort_reason().value_or("");
  EXPECT_LT((place(vehicle) - back[1]).norm(), 0.1);
  EXPECT_LT(drive_of.speed_min_m_s, -0.3);
  EXPECT_LT(drive_of.off_line_max_m, 0.15);
}

TEST(WaypointDriver, TurnsIfItMayNotReverse) {
  const Site site(hall());
  VehicleModel vehicle(site, {}, {}, 1, 0);
  WaypointDriver driver(waypoints({{-8.0, 2.0}}), {}, WaypointDriverParams{.off_path_max_m = 5.0});
  const Drive drive_of = drive(driver, vehicle, WaypointPath({{0.0, 0.0}, {-8.0, 2.0}}), 200.0);
  EXPECT_TRUE(driver.done()) << driver.abort_reason().value_or("");
  EXPECT_GE(drive_of.speed_min_m_s, 0.0);
}

TEST(WaypointDriver, AbortsFarOffThePath) {
  WaypointDriver driver(waypoints({{10.0, 0.0}}), {});
  BodyMotion motion;
  EXPECT_GT(driver.command(motion).speed_m_s, 0.0);
  motion.T_world_body.translation() = Eigen::Vector3d(0.5, 2.1, 0.0);
  EXPECT_EQ(driver.command(motion).speed_m_s, 0.0);
  ASSERT_TRUE(driver.abort_reason());
  EXPECT_THAT(*driver.abort_reason(), HasSubstr("off the path after 0.50 m"));
}

TEST(WaypointDriver, AbortsWithoutProgress) {
  WaypointDriver driver(waypoints({{10.0, 0.0}}), {});
  BodyMotion motion;
  motion.utime = 5'000'000;
  driver.command(motion);
  motion.utime += 20'000'000;
  EXPECT_GT(driver.command(motion).speed_m_s, 0.0);
  motion.utime += 100'000;
  EXPECT_EQ(driver.command(motion).speed_m_s, 0.0);
  ASSERT_TRUE(driver.abort_reason());
  EXPECT_THAT(*driver.abort_reason(), HasSubstr("no progress after 0.00 m"));
}

TEST(WaypointDriver, IsDoneImmediatelyAtTheLastWaypoint) {
  WaypointDriver driver(waypoints({{0.0, 0.0}}), {});
  EXPECT_EQ(driver.command({}).speed_m_s, 0.0);
  EXPECT_TRUE(driver.done());
}

TEST(WaypointDriver, RejectsInvalidWaypoints) {
  EXPECT_THROW(WaypointDriver({}, {}), std::invalid_argument);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(WaypointDriver(waypoints({{0.0, nan}}), {}), std::invalid_argument);
}

}  // namespace
}  // namespace adit
