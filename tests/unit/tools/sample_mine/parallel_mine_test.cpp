// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sample_mine/parallel_mine.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tools/sample_mine/sample_run.hpp"

namespace adit {
namespace {

const Eigen::Vector2d kNorth(0.0, 12.0);  // from a place in the south drift to its like

double range(const SyntheticWorld& mine, const Eigen::Vector2d& p, double angle) {
  return mine.cast(p, angle, 80.0).value_or(80.0);
}

TEST(ParallelMine, ItsDriftsLookTheSame) {
  const SyntheticWorld mine = parallel_mine(1);
  for (double x = 0.0; x < 50.0; x += 0.7) {
    for (double angle = 0.3; angle < 2.9; angle += 0.05) {  // what is seen of the walls close by
      for (const double side : {1.0, -1.0}) {
        const double south = range(mine, {x, 0.0}, side * angle);
        const double north = range(mine, Eigen::Vector2d(x, 0.0) + kNorth, side * angle);
        ASSERT_NEAR(south, north, 1e-6) << x << ' ' << angle;
      }
    }
  }
}

TEST(ParallelMine, TheirEastEndsDoNot) {
  const SyntheticWorld mine = parallel_mine(1);
  constexpr double kUp = std::numbers::pi / 2.0;
  EXPECT_GT(range(mine, {70.0, 0.0}, kUp), 10.0);  // the south drift turns north
  EXPECT_LT(range(mine, {70.0, 12.0}, kUp), 3.0);  // where the north drift ends in rock
  EXPECT_LT(range(mine, {70.0, 0.0}, -kUp), 3.0);  // and the other way round
  EXPECT_GT(range(mine, {70.0, 12.0}, -kUp), 10.0);
  EXPECT_GT(range(mine, {70.0, 0.0}, -0.2), 10.0);  // the dead end
  EXPECT_LT(range(mine, {70.0, 12.0}, -0.2), 3.0);
}

class ParallelMines : public testing::TestWithParam<std::uint64_t> {};

TEST_P(ParallelMines, CanBeDrivenWithRoomToSpare) {
  const SyntheticWorld mine = parallel_mine(GetParam());
  for (const auto& [utime, pose] : drive_route(parallel_mine_route(), {}, 0)) {
    ASSERT_FALSE(mine.clearance(pose.translation(), 0.5)) << pose.x << ' ' << pose.y;
  }
}

TEST_P(ParallelMines, TheRobotBelievesItselfInTheOtherDriftWhenItComesBack) {
  SampleRun run(sample_site(SampleWorld::kParallel, GetParam()), GetParam());
  const Pose2 start = run.truth().front().pose;
  double nearest_m = 1e9;
  Pose2 estimated;
  std::size_t i = 0;
  while (const auto reading = run.next()) {
    const Pose2& truth = run.truth()[i++].pose;
    const double off_m = (truth.translation() - Eigen::Vector2d(0.0, 0.0)).norm();
    if (i < 4000 || off_m > nearest_m) continue;  // the second time that it comes by
    nearest_m = off_m;
    estimated = start * reading->odometry.T_wheel_body;
  }
  EXPECT_LT(nearest_m, 0.2);
  EXPECT_NEAR(estimated.x, kNorth.x(), 2.0);
  EXPECT_NEAR(estimated.y, kNorth.y(), 4.0);  // 6 would be half-way
  EXPECT_LT(std::abs(estimated.theta), 0.17);
}

INSTANTIATE_TEST_SUITE_P(Seeds, ParallelMines, testing::Values(1, 2, 3, 42));

}  // namespace
}  // namespace adit
