// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sim/sample_run.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "sim/world/build_world.hpp"
#include "sim/world/world_file.hpp"
#include "tests/support/worlds/wall_world.hpp"

namespace adit {
namespace {

TEST(SampleRun, GivesAScanWithTheOdometryAndTheTruthAtItsTime) {
  SampleRun run({.length_max_m = 30.0});
  std::size_t count = 0;
  while (const auto reading = run.next()) {
    ++count;
    EXPECT_EQ(reading->scan.ranges_m.size(), 181U);
    EXPECT_EQ(reading->odometry.utime, reading->scan.utime);
    EXPECT_EQ(run.truth().back().utime, reading->scan.utime);
  }
  EXPECT_EQ(count, run.truth().size());
  EXPECT_DOUBLE_EQ(run.fraction_done(), 1.0);
}

TEST(SampleRun, OfHalfADegreeHas361BeamsAtTheSameDistances) {
  SampleRun coarse({.length_max_m = 30.0});
  SampleRun fine({.beams = 361, .length_max_m = 30.0});
  while (coarse.next()) {
  }
  while (const auto reading = fine.next()) EXPECT_EQ(reading->scan.ranges_m.size(), 361U);
  EXPECT_EQ(fine.truth().size(), coarse.truth().size());
}

TEST(SampleRun, DependsOnItsSeed) {
  const auto first_scan = [](int seed) { return SampleRun({.seed = seed}).next()->scan; };
  EXPECT_EQ(first_scan(3), first_scan(3));
  EXPECT_NE(first_scan(3), first_scan(4));
}

TEST(SampleRun, OfLessLengthIsTheBeginningOfALongerOne) {
  constexpr double kLengthM = 20.0;
  SampleRun longer({.length_max_m = 2.0 * kLengthM});
  SampleRun shorter({.length_max_m = kLengthM});
  while (const auto reading = shorter.next()) EXPECT_EQ(reading->scan, longer.next()->scan);
  EXPECT_LE(path_length_m(shorter.truth()), kLengthM);
  EXPECT_NEAR(path_length_m(shorter.truth()), kLengthM, 0.17);  // from scan to scan
}

TEST(SampleRun, OfTheGridHasAScanEachTenthOfAMetre) {
  SampleRun run({.world = "grid", .length_max_m = 100.0});
  while (run.next()) {
  }
  // A tenth of a metre at full speed; less from rest and in bends, where the vehicle is slower.
  EXPECT_GE(run.truth().size(), 990U);
  EXPECT_LE(run.truth().size(), 1200U);
}

TEST(SampleRun, HasABiasOfTheOdometryOnRequest) {
  constexpr double kBiasRadPerM = 0.01;
  const auto odometry_after = [](double bias) {
    SampleRun run({.turn_bias_rad_per_m = bias, .length_max_m = 20.0});
    Pose2 T_wheel_body;
    while (const auto reading = run.next()) T_wheel_body = reading->odometry.T_wheel_body;
    return T_wheel_body.theta;
  };
  // The bias is per metre that the wheels roll, which is 3 % more than the robot moves.
  EXPECT_NEAR(odometry_after(kBiasRadPerM) - odometry_after(0.0), 20.6 * kBiasRadPerM, 0.01);
}

TEST(SampleRun, RejectsAWorldWithoutADrive) {
  EXPECT_THROW(SampleRun({.world = "florence"}), std::runtime_error);
}

class SampleDrive : public testing::TestWithParam<std::tuple<int, double>> {};

TEST_P(SampleDrive, ReturnsToItsStartWithoutACollision) {
  const auto [seed, length_m] = GetParam();
  SampleRun run({.seed = seed});
  Pose2 T_wheel_body;
  while (const auto reading = run.next()) T_wheel_body = reading->odometry.T_wheel_body;
  EXPECT_NEAR(path_length_m(run.truth()), length_m, 3.0);
  const Pose2 truth = between(run.truth().front().pose, run.truth().back().pose);
  EXPECT_LT(truth.translation().norm(), 0.5);
  EXPECT_GT((T_wheel_body.translation() - truth.translation()).norm(), 1.0);  // wheels are worse
}

INSTANTIATE_TEST_SUITE_P(Seeds, SampleDrive,
                         testing::Values(std::tuple{1, 446.0}, std::tuple{42, 446.0}));

constexpr double kApartM = 12.0;

double range_m(const test::WallWorld& world, const Eigen::Vector2d& p, double angle_rad) {
  return world.cast(p, angle_rad, 80.0).value_or(80.0);
}

test::WallWorld parallel_world(int seed) {
  return {build_world(find_world("parallel", seed)), 0.62};
}

class ParallelTunnels : public testing::TestWithParam<int> {};

TEST_P(ParallelTunnels, HaveTheSameWalls) {
  const test::WallWorld world = parallel_world(GetParam());
  for (double x = 2.0; x < 50.0; x += 0.7) {
    for (double angle = 0.3; angle < 2.9; angle += 0.05) {  // the walls close by
      for (const double side : {1.0, -1.0}) {
        const double south = range_m(world, {x, 0.0}, side * angle);
        const double north = range_m(world, {x, kApartM}, side * angle);
        ASSERT_NEAR(south, north, 1e-3) << x << ' ' << angle;  // single precision, grazing
      }
    }
  }
}

TEST_P(ParallelTunnels, DifferAtTheirEastEnds) {
  const test::WallWorld world = parallel_world(GetParam());
  constexpr double kNorth = std::numbers::pi / 2.0;
  EXPECT_GT(range_m(world, {70.0, 0.0}, kNorth), 10.0);  // the corner
  EXPECT_LT(range_m(world, {70.0, kApartM}, kNorth), 3.0);
  EXPECT_LT(range_m(world, {70.0, 0.0}, -kNorth), 3.0);
  EXPECT_GT(range_m(world, {70.0, kApartM}, -kNorth), 10.0);
  EXPECT_GT(range_m(world, {70.0, 0.0}, -0.2), 10.0);  // the dead end
  EXPECT_LT(range_m(world, {70.0, kApartM}, -0.2), 3.0);
}

INSTANTIATE_TEST_SUITE_P(Seeds, ParallelTunnels, testing::Values(1, 2));

TEST(ParallelDriveOdometry, PlacesTheRobotInTheOtherTunnelAfterTheLoop) {
  constexpr double kLoopM = 600.0;  // before the second pass
  SampleRun run({.world = "parallel"});
  double nearest_m = 1e9;
  double length_m = 0.0;
  Pose2 estimate;
  while (const auto reading = run.next()) {
    const Trajectory& truth = run.truth();
    if (truth.size() > 1) {
      length_m +=
          (truth.back().pose.translation() - truth[truth.size() - 2].pose.translation()).norm();
    }
    const double distance_m = truth.back().pose.translation().norm();  // to (0, 0)
    if (length_m < kLoopM || distance_m > nearest_m) continue;
    nearest_m = distance_m;
    estimate = truth.front().pose * reading->odometry.T_wheel_body;
  }
  EXPECT_LT(nearest_m, 0.2);
  EXPECT_NEAR(estimate.x, 0.0, 2.0);
  EXPECT_NEAR(estimate.y, kApartM, 4.0);  // 6 is the middle
  EXPECT_LT(std::abs(estimate.theta), 0.17);
}

}  // namespace
}  // namespace adit
