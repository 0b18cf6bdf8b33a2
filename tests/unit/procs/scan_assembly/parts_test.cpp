// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// The parts of scan assembly, each alone.
#include <limits>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "procs/scan_assembly/beam_placement.hpp"
#include "procs/scan_assembly/gravity.hpp"
#include "procs/scan_assembly/sweep_motion.hpp"

namespace adit {
namespace {

TEST(InterpolationBuffer, InterpolatesWhateverTheOrder) {
  InterpolationBuffer<double> track;
  EXPECT_FALSE(track.at(0));
  EXPECT_TRUE(track.add(2000, 3.0));
  EXPECT_TRUE(track.add(1000, 1.0));
  EXPECT_FALSE(track.add(2000, 9.0));
  EXPECT_DOUBLE_EQ(*track.at(1500), 2.0);
  EXPECT_DOUBLE_EQ(*track.at(1000), 1.0);
  EXPECT_DOUBLE_EQ(*track.at(0), 1.0);
  EXPECT_DOUBLE_EQ(*track.at(5000), 3.0);
}

TEST(InterpolationBuffer, InterpolatesPosesTheShortWayRound) {
  InterpolationBuffer<Pose2> track;
  track.add(0, {1.0, 2.0, 3.1});
  track.add(1000, {1.0, 2.0, -3.1});
  EXPECT_NEAR(std::abs(track.at(500)->theta), std::numbers::pi, 1e-12);
}

GravityEstimator after(int readings, const Eigen::Vector3d& force) {
  GravityEstimator gravity(GravityParams{});
  for (int i = 0; i < readings; ++i) gravity.add({1000 * i, {}, force});
  return gravity;
}

TEST(GravityEstimator, IsTheMeanOfTheSpecificForceAtRest) {
  const Eigen::Vector3d up = Eigen::Vector3d(0.1, -0.05, 1.0).normalized();
  EXPECT_LT((*after(100, 9.81 * up).up_body() - up).norm(), 1e-12);
}

TEST(GravityEstimator, IsNotKnownFromFewReadingsOrWhileTheBodyIsShaken) {
  EXPECT_FALSE(after(99, {0.0, 0.0, 9.81}).up_body());
  EXPECT_FALSE(after(100, {0.0, 0.0, 10.5}).up_body());
  EXPECT_FALSE(after(100, {0.0, 0.0, 0.0}).up_body());
}

TEST(GravityEstimator, ForgetsOldReadings) {
  GravityEstimator gravity = after(100, {9.81, 0.0, 0.0});
  for (int i = 0; i < 100; ++i) gravity.add({i, {}, {0.0, 0.0, 9.81}});
  EXPECT_EQ(*gravity.up_body(), Eigen::Vector3d::UnitZ());
}

TEST(Levelling, MakesUpVerticalAndKeepsTheHeading) {
  const Eigen::Vector3d up = Eigen::Vector3d(0.2, -0.3, 1.0).normalized();
  const Eigen::Matrix3d R = level_rotation(up);
  EXPECT_LT((R * up - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_LT((R * R.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_NEAR(R.determinant(), 1.0, 1e-12);
  const Eigen::Vector3d forward = R * Eigen::Vector3d::UnitX();
  EXPECT_NEAR(forward.y(), 0.0, 1e-12);
  EXPECT_GT(forward.x(), 0.0);
}

class SweepMotionTest : public testing::Test {
 protected:
  void reads(double angle_rad) { sweep_.add({0, angle_rad, 0.0}); }
  /// The goal of the command that is sent at a time; NaN for none.
  double goal_at(std::int64_t utime) {
    const auto command = sweep_.advance(utime);
    return command ? command->angle_rad : std::numeric_limits<double>::quiet_NaN();
  }

  SweepMotion sweep_{SweepMotionParams{}};
};

TEST_F(SweepMotionTest, GoesThereThroughItAndBack) {
  sweep_.begin();
  EXPECT_EQ(goal_at(0), -0.5);
  reads(-0.5);
  EXPECT_TRUE(std::isnan(goal_at(1)));  // it may not stand yet
  reads(-0.5);
  EXPECT_EQ(goal_at(2), 0.5);
  EXPECT_EQ(sweep_.phase(), SweepMotion::Phase::kSweep);
  reads(0.5);
  reads(0.5);
  EXPECT_EQ(goal_at(3), 0.0);
  reads(0.0);
  reads(0.0);
  EXPECT_TRUE(std::isnan(goal_at(4)));
  EXPECT_EQ(sweep_.phase(), SweepMotion::Phase::kIdle);
}

TEST_F(SweepMotionTest, GoesOnOnlyWhenTheLaserStandsAtItsGoal) {
  sweep_.begin();
  goal_at(0);
  reads(-0.49);
  reads(-0.499);  // near, but on its way
  EXPECT_TRUE(std::isnan(goal_at(1)));
  reads(-0.48);
  reads(-0.48);  // stands, but elsewhere
  EXPECT_TRUE(std::isnan(goal_at(2)));
}

TEST_F(SweepMotionTest, RepeatsItsCommandEachSecond) {
  sweep_.begin();
  EXPECT_EQ(goal_at(0), -0.5);
  EXPECT_TRUE(std::isnan(goal_at(999'999)));
  EXPECT_EQ(goal_at(1'000'000), -0.5);
  EXPECT_TRUE(std::isnan(goal_at(1'000'001)));
}

}  // namespace
}  // namespace adit
