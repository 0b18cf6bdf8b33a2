// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/eval/trajectory.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

TEST(Trajectory, InterpolatesTheShortWayRound) {
  const Trajectory trajectory{{1'000'000, {0.0, 0.0, deg_to_rad(170.0)}},
                              {3'000'000, {2.0, 4.0, deg_to_rad(-170.0)}}};
  const auto pose = interpolate(trajectory, 1'500'000);
  ASSERT_TRUE(pose);
  EXPECT_DOUBLE_EQ(pose->x, 0.5);
  EXPECT_DOUBLE_EQ(pose->y, 1.0);
  EXPECT_NEAR(rad_to_deg(pose->theta), 175.0, 1e-9);
}

TEST(Trajectory, GivesItsOwnPosesBack) {
  const Trajectory trajectory{{10'000, {1, 2, 3}}, {20'000, {4, 5, 1}}, {30'000, {7, 8, 2}}};
  for (const auto& [utime, pose] : trajectory) EXPECT_EQ(interpolate(trajectory, utime), pose);
}

TEST(Trajectory, HasNoPoseBeyondItsEnds) {
  const Trajectory trajectory{{1'000'000, {1, 0, 0}}, {2'000'000, {2, 0, 0}}};
  EXPECT_FALSE(interpolate(trajectory, 998'000));
  EXPECT_FALSE(interpolate(trajectory, 2'002'000));
  EXPECT_EQ(interpolate(trajectory, 999'990), trajectory.front().pose);
  EXPECT_EQ(interpolate(trajectory, 2'000'010), trajectory.back().pose);
  EXPECT_FALSE(interpolate({}, 0));
}

TEST(Trajectory, MeasuresItsLength) {
  EXPECT_DOUBLE_EQ(path_length_m({{1, {0, 0, 0}}, {2, {3, 4, 0}}, {3, {3, 5, 0}}}), 6.0);
  EXPECT_DOUBLE_EQ(path_length_m({}), 0.0);
}

}  // namespace
}  // namespace adit
