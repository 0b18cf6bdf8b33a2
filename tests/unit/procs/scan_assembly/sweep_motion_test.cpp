// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_assembly/sweep_motion.hpp"

#include <cmath>
#include <cstdint>
#include <limits>

#include <gtest/gtest.h>

namespace adit {
namespace {

class SweepMotionTest : public testing::Test {
 protected:
  void read(double angle_rad) { sweep_.add({0, angle_rad, 0.0}); }
  /// The goal of the command at a time; NaN without a command.
  double goal_at(std::int64_t utime) {
    const auto command = sweep_.advance(utime);
    return command ? command->angle_rad : std::numeric_limits<double>::quiet_NaN();
  }

  SweepMotion sweep_{SweepMotionParams{}};
};

TEST_F(SweepMotionTest, MovesToTheStartThroughTheSweepAndBack) {
  sweep_.begin();
  EXPECT_EQ(goal_at(0), -0.5);
  read(-0.5);
  EXPECT_TRUE(std::isnan(goal_at(1)));  // the laser may still move
  read(-0.5);
  EXPECT_EQ(goal_at(2), 0.5);
  EXPECT_EQ(sweep_.phase(), SweepMotion::Phase::kSweep);
  read(0.5);
  read(0.5);
  EXPECT_EQ(goal_at(3), 0.0);
  read(0.0);
  read(0.0);
  EXPECT_TRUE(std::isnan(goal_at(4)));
  EXPECT_EQ(sweep_.phase(), SweepMotion::Phase::kIdle);
}

TEST_F(SweepMotionTest, EntersTheNextPhaseWhenTheLaserStandsAtItsGoal) {
  sweep_.begin();
  goal_at(0);
  read(-0.49);
  read(-0.499);  // near, but moving
  EXPECT_TRUE(std::isnan(goal_at(1)));
  read(-0.48);
  read(-0.48);  // standing, but elsewhere
  EXPECT_TRUE(std::isnan(goal_at(2)));
}

TEST_F(SweepMotionTest, RepeatsTheCommandEachSecond) {
  sweep_.begin();
  EXPECT_EQ(goal_at(0), -0.5);
  EXPECT_TRUE(std::isnan(goal_at(999'999)));
  EXPECT_EQ(goal_at(1'000'000), -0.5);
  EXPECT_TRUE(std::isnan(goal_at(1'000'001)));
}

}  // namespace
}  // namespace adit
