// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/drive/drive_plan.hpp"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kExact = 1e-12;

/// 3 m along x, then 4 m along y, then 3 m back along −x.
WaypointPath hook() { return WaypointPath({{0.0, 0.0}, {3.0, 0.0}, {3.0, 4.0}, {0.0, 4.0}}); }

TEST(WaypointPath, IsParametrisedByDistanceAndContinuesBeyondItsEnd) {
  const WaypointPath path = hook();
  EXPECT_DOUBLE_EQ(path.length_m(), 10.0);
  EXPECT_TRUE(path.at(2.0).isApprox(Eigen::Vector2d(2.0, 0.0), kExact));
  EXPECT_TRUE(path.at(5.0).isApprox(Eigen::Vector2d(3.0, 2.0), kExact));
  EXPECT_TRUE(path.at(12.0).isApprox(Eigen::Vector2d(-2.0, 4.0), kExact));
  EXPECT_EQ(path.leg(-1.0), 0U);
  EXPECT_EQ(path.leg(3.0), 1U);
  EXPECT_EQ(path.leg(99.0), 2U);
  EXPECT_NEAR(path.heading_rad(1), std::numbers::pi / 2.0, kExact);
}

TEST(WaypointPath, FindsTheNearestPointBetweenTwoDistances) {
  const WaypointPath path = hook();
  const Eigen::Vector2d p(1.0, 2.5);  // nearest to the last leg
  EXPECT_NEAR(path.nearest_m(p, 0.0, 10.0), 9.0, kExact);
  EXPECT_NEAR(path.nearest_m(p, 0.0, 6.0), 5.5, kExact);
  EXPECT_NEAR(path.nearest_m(p, 0.0, 2.0), 1.0, kExact);
  EXPECT_NEAR(path.nearest_m(p, 2.0, 2.5), 2.0, kExact);
}

}  // namespace
namespace {

using testing::ElementsAre;
using testing::SizeIs;

Waypoint at(double x, double y, std::optional<double> speed_m_s = {}) {
  return {{x, y}, speed_m_s};
}

constexpr DrivePlanParams kForward{0.4, 0.5, false};
constexpr DrivePlanParams kReversing{0.4, 0.5, true};

TEST(DrivePlan, IsOneRunWithoutReversing) {
  const auto plan = plan_drive({at(5, 0), at(5, 4), at(5, 0)}, {}, kForward);
  ASSERT_THAT(plan, SizeIs(1));
  EXPECT_DOUBLE_EQ(plan[0].path.length_m(), 13.0);
  EXPECT_FALSE(plan[0].reverse);
}

TEST(DrivePlan, IsSplitWhereTheDrivingDirectionChanges) {
  const auto plan = plan_drive({at(5, 0), at(8, 1), at(3, 0), at(9, 0)}, {}, kReversing);
  ASSERT_THAT(plan, SizeIs(3));
  EXPECT_FALSE(plan[0].reverse);
  EXPECT_TRUE(plan[1].reverse);
  EXPECT_FALSE(plan[2].reverse);
  EXPECT_THAT(plan[0].speeds_m_s, SizeIs(2));
  EXPECT_EQ(plan[1].path.at(0.0), Eigen::Vector2d(8, 1));
}

TEST(DrivePlan, TurnsToWaypointsAtTheSide) {
  EXPECT_FALSE(plan_drive({at(-1, 1.01)}, {}, kReversing)[0].reverse);  // 45° from straight back
  EXPECT_TRUE(plan_drive({at(-1, 0.99)}, {}, kReversing)[0].reverse);
}

TEST(DrivePlan, UsesTheSpeedsOfWaypointsUpToTheLimitOfTheVehicle) {
  const auto plan = plan_drive({at(1, 0), at(2, 0, 0.2), at(3, 0, 7.0)}, {}, kForward);
  ASSERT_THAT(plan, SizeIs(1));
  EXPECT_THAT(plan[0].speeds_m_s, ElementsAre(0.4, 0.2, 0.5));
}

TEST(DrivePlan, IgnoresRepeatedWaypoints) {
  EXPECT_THAT(plan_drive({at(0, 0), at(0.0005, 0)}, {}, kForward), SizeIs(0));
}

}  // namespace
}  // namespace adit
