// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sample_mine/mine_worlds.hpp"

#include <gtest/gtest.h>

#include "tools/sample_mine/route_driver.hpp"

namespace adit {
namespace {

constexpr std::int64_t kStart = 1'000'000'000'000;

TEST(RouteDriver, ReachesTheLastWaypointPastAllOthers) {
  const std::vector<Eigen::Vector2d> route = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  const DriveModel model;
  const Trajectory path = drive_route(route, model, kStart);
  EXPECT_EQ(path.front(), (TimedPose{kStart, {0.0, 0.0, 0.0}}));
  for (const Eigen::Vector2d& waypoint : route) {
    double nearest = 1e9;
    for (const auto& p : path)
      nearest = std::min(nearest, (p.pose.translation() - waypoint).norm());
    EXPECT_LT(nearest, 0.8);  // half the look-ahead and a little
  }
  EXPECT_LT((path.back().pose.translation() - route.back()).norm(), 0.2);
}

TEST(RouteDriver, MovesAsAVehicleCan) {
  const DriveModel model;
  const Trajectory path = drive_route(sample_mine_route(), model, kStart);
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Pose2 step = between(path[i - 1].pose, path[i].pose);
    EXPECT_EQ(path[i].utime - path[i - 1].utime, 200'000);
    EXPECT_LE(std::abs(step.theta), model.yaw_rate_max_rad_s * model.period_s + 1e-9);
    EXPECT_LE(step.translation().norm(), model.speed_m_s * model.period_s + 1e-9);
  }
}

class SampleMine : public testing::TestWithParam<std::uint64_t> {};

TEST_P(SampleMine, CanBeDrivenWithRoomToSpare) {
  const SyntheticWorld mine = sample_mine(GetParam());
  for (const auto& [utime, pose] : drive_route(sample_mine_route(), {}, kStart)) {
    ASSERT_FALSE(mine.clearance(pose.translation(), 0.6)) << pose.x << ' ' << pose.y;
  }
}

TEST_P(SampleMine, IsClosedButForThePortal) {
  const SyntheticWorld mine = sample_mine(GetParam());
  for (double angle = 0.0; angle < 6.28; angle += 0.01) {
    EXPECT_TRUE(mine.cast({104.0, 34.0}, angle, 80.0)) << angle;
  }
  EXPECT_FALSE(mine.cast({0.0, 0.0}, std::numbers::pi, 80.0));
}

INSTANTIATE_TEST_SUITE_P(Seeds, SampleMine, testing::Values(1, 2, 3, 42));

TEST(SampleMine, TheWallsComeFromTheSeed) {
  EXPECT_NE(sample_mine(1).walls().front().a, sample_mine(2).walls().front().a);
  EXPECT_EQ(sample_mine(1).walls().front().a, sample_mine(1).walls().front().a);
}

TEST(SampleMine, ItsRouteIsOfSomeHundredMetres) {
  const double length = path_length_m(drive_route(sample_mine_route(), {}, kStart));
  EXPECT_NEAR(length, 450.0, 20.0);
}

}  // namespace
}  // namespace adit
