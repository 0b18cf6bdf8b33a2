// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Drives along the traversed path without a 3D scan.
#include <gtest/gtest.h>

#include "procs/mission/maneuver.hpp"
#include "tests/unit/procs/mission/scripted_stages.hpp"

namespace adit {
namespace {

/// 20 m into the mine, after a scan there.
class MissionInTransit : public ScriptedStages {
 protected:
  void SetUp() override {
    to_execute();
    drive(20.0);
    arrive();
    answer(Kind::kGoTo);
    terrain();
    path(PlanOutcome::kFound);
    arrive();
    ASSERT_EQ(now(), Phase::kExplore);
    ASSERT_EQ(scans_, 2);
  }

  /// 28 m farther into the mine, a scan for a route home.
  void scan_after_thirty_metres() {
    reach_m_ = 20.0;
    answer(Kind::kGoTo, 1);
    terrain();
    path(PlanOutcome::kFound);
    drive(28.0);
    arrive();
    reach_m_ = -12.0;
    answer(Kind::kHome);
    ASSERT_EQ(now(), Phase::kScan);
    terrain();
  }
};

TEST_F(MissionInTransit, DrivesBackAlongTheTraversedPathWithoutAScan) {
  reach_m_ = -12.0;
  answer(Kind::kHome);
  ASSERT_EQ(now(), Phase::kPlan);
  EXPECT_EQ(goal_.kind, PlanGoal::Kind::kRetrace);
  EXPECT_NEAR(goal_.distance_m, 12.0 - 1.5, 0.7);  // to before the end of the route
  EXPECT_EQ(phase().laser, LaserId::kRear);
}

TEST_F(MissionInTransit, DrivesHomeAtOnce) {
  reach_m_ = -20.0;
  answer(Kind::kHome);
  ASSERT_EQ(now(), Phase::kPlan);
  EXPECT_EQ(goal_.kind, PlanGoal::Kind::kRetrace);
  EXPECT_NEAR(goal_.distance_m, 20.0, 0.7);  // home, at the end of the traversed path
}

/// A loop closure: the ground that the robot drove outbound lies elsewhere in odom.
TEST_F(MissionInTransit, BeginsTheDriveAgainWhereTheMapMovesTheTraversedPath) {
  MapCorrection correction;
  correction.utime = utime_;
  mission_.add_correction(correction);
  reach_m_ = -12.0;
  answer(Kind::kHome);
  path(PlanOutcome::kFound);
  ASSERT_EQ(now(), Phase::kExecute);
  correction.T_map_odom.y = 0.07;
  mission_.add_correction(correction);
  EXPECT_EQ(now(), Phase::kExecute);
  correction.T_map_odom.y = 0.14;
  mission_.add_correction(correction);
  EXPECT_EQ(now(), Phase::kExplore);
  EXPECT_EQ(phase().reason, "the map has moved the traversed path by 0.14 m");
  tick();
  answer(Kind::kHome);
  ASSERT_EQ(now(), Phase::kPlan);
  EXPECT_EQ(goal_.kind, PlanGoal::Kind::kRetrace);
  EXPECT_NEAR(goal_.traversed_path_odom.back().y, -0.14, 1e-9);
}

TEST_F(MissionInTransit, ScansWhereItHasNotBeen) {
  reach_m_ = 12.0;
  answer(Kind::kGoTo, 1);
  EXPECT_EQ(now(), Phase::kScan);
}

TEST_F(MissionInTransit, ScansAfterADriveWithoutScansThatFailed) {
  reach_m_ = -12.0;
  answer(Kind::kHome);
  path(PlanOutcome::kFound);
  driving(DrivingState::Kind::kFailed, "held by a stop order, no progress for 10 s");
  tick();
  ASSERT_EQ(now(), Phase::kExplore);
  answer(Kind::kHome);
  EXPECT_EQ(now(), Phase::kScan);
}

TEST_F(MissionInTransit, ScansAfterThirtyMetresWithoutAScan) {
  scan_after_thirty_metres();
  ASSERT_EQ(now(), Phase::kPlan);
  tick();
  EXPECT_EQ(goal_.kind, PlanGoal::Kind::kRejoin);  // and continues along the traversed path
  ASSERT_FALSE(goal_.traversed_path_odom.empty());
  const Eigen::Vector2d back = goal_.traversed_path_odom.back().translation() -
                               goal_.traversed_path_odom.front().translation();
  EXPECT_NEAR(back.norm(), 12.0 - 1.5, 0.7);  // no pose beyond the end of the route
}

TEST_F(MissionInTransit, FollowsTheRouteWhereNoPathLeadsOntoDrivenGraph) {
  scan_after_thirty_metres();
  tick();
  ASSERT_EQ(goal_.kind, PlanGoal::Kind::kRejoin);
  const int scans = scans_;
  path(PlanOutcome::kBlocked);
  ASSERT_EQ(now(), Phase::kPlan);  // over the same scan
  tick();
  EXPECT_EQ(goal_.kind, PlanGoal::Kind::kRoute);
  EXPECT_EQ(scans_, scans);
  path(PlanOutcome::kFound);
  EXPECT_EQ(now(), Phase::kExecute);
}

class TransitHome : public testing::Test {
 protected:
  TransitHome() {
    for (int i = 0; i <= 300; ++i) path_.add(i, {0.2 * i, 0.0, 0.0});  // 60 m
  }
  /// Length of the transit from the end of the path over a route to its start, `route_m` long.
  [[nodiscard]] std::optional<double> length_m(double route_m, double unscanned_m,
                                               bool ends_at_home = true) const {
    const double x_m = path_.T_odom_body()->x;
    std::vector<Eigen::Vector2d> route_odom;
    for (int i = 0; i <= 100; ++i) route_odom.emplace_back(x_m - route_m * i / 100, 0.0);
    const auto transit = Retracing{}.transit(path_, route_odom, unscanned_m, ends_at_home, true);
    return transit ? std::optional(transit->distance_m) : std::nullopt;
  }

  TraversedPath path_;
};

TEST_F(TransitHome, NeedsNoScanForTheLastMetres) {
  EXPECT_NEAR(length_m(28.0, 0.0).value(), 28.0, 1e-6);
  EXPECT_NEAR(length_m(33.0, 0.0).value(), 33.0, 1e-6);  // 3 m more than without a scan
  EXPECT_NEAR(length_m(36.0, 0.0).value(), 30.0, 1e-6);  // a scan there, and 6 m more
  EXPECT_NEAR(length_m(1.5, 10.0).value(), 1.5, 1e-6);
  EXPECT_NEAR(length_m(3.0, 29.0).value(), 3.0, 1e-6);
  EXPECT_FALSE(length_m(5.0, 29.5));
  EXPECT_FALSE(length_m(0.5, 10.0));  // too short a path to retrace
}

TEST_F(TransitHome, EndsBeforeTheRouteLeavesTheTraversedPath) {
  EXPECT_NEAR(length_m(28.0, 0.0, false).value(), 26.5, 1e-6);
  EXPECT_NEAR(length_m(33.0, 0.0, false).value(), 30.0, 1e-6);
  EXPECT_FALSE(length_m(5.0, 0.0, false));
}

}  // namespace
}  // namespace adit
