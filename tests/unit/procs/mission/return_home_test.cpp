// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// The last metres home: as near to the start as possible, with a limited number of tries.
#include <gmock/gmock.h>

#include "tests/unit/procs/mission/scripted_stages.hpp"

namespace adit {
namespace {

using testing::HasSubstr;

class MissionNearHome : public ScriptedStages {
 protected:
  /// Exploration leads home, the origin of odom, over this distance.
  void lead_home(double from_m) {
    x_m_ = from_m;
    reach_m_ = -from_m;
    tick();
    if (now() != Phase::kExplore) to_explore();
    answer(Kind::kHome);
  }
};

TEST_F(MissionNearHome, PlansToTheStartIfTheRouteEndsThere) {
  lead_home(8.0);
  terrain();
  EXPECT_EQ(goal_.kind, PlanGoal::Kind::kRouteTo);
  EXPECT_EQ(goal_.route_odom.back(), Eigen::Vector2d(0.0, 0.0));
}

TEST_F(MissionNearHome, FollowsTheRouteIfItEndsBefore) {
  x_m_ = 30.0;
  reach_m_ = -12.0;
  to_scan(Kind::kHome);
  terrain();
  EXPECT_EQ(goal_.kind, PlanGoal::Kind::kRoute);
}

TEST_F(MissionNearHome, EndsAtHomeIfNoPathLeadsNearer) {
  lead_home(0.4);
  for (const LaserId laser : {LaserId::kRear, LaserId::kFront}) {
    ASSERT_EQ(now(), Phase::kScan);
    EXPECT_EQ(scan_.laser, laser);
    terrain();
    path(PlanOutcome::kBlocked);
  }
  ASSERT_EQ(now(), Phase::kEnded);
  EXPECT_EQ(phase().outcome, MissionOutcome::kHome);
  EXPECT_THAT(phase().reason, HasSubstr("at home: 0.40 m from the start, it gets no nearer"));
}

TEST_F(MissionNearHome, TriesTwiceToGetNearer) {
  for (int i = 0; i < 2; ++i) {
    lead_home(0.4);
    ASSERT_EQ(now(), Phase::kScan) << i;
    terrain();
    path(PlanOutcome::kFound);
    arrive();
    ASSERT_EQ(now(), Phase::kExplore);
  }
  answer(Kind::kHome);
  ASSERT_EQ(now(), Phase::kEnded);
  EXPECT_EQ(phase().outcome, MissionOutcome::kHome);
  EXPECT_EQ(phase().scans, 2);
}

TEST_F(MissionNearHome, DoesNotAcceptAMetreAsHome) {
  lead_home(1.0);
  terrain();
  path(PlanOutcome::kBlocked);
  EXPECT_NE(now(), Phase::kEnded);
}

/// At home after a drive of 8 m, by the decision of exploration.
class MissionAtHome : public ScriptedStages {
 protected:
  void SetUp() override {
    to_execute();
    drive(8.0);
    while (x_m_ > 0.3) {
      x_m_ -= 0.25;
      tick();
    }
    arrive();
    ASSERT_EQ(now(), Phase::kExplore);
  }
  /// Exploration is not asked until mapping has matched what is seen.
  void stand() {
    const int explores = explores_;
    wait(4.0);
    EXPECT_EQ(explores_, explores);
    wait(2.0);
    EXPECT_GT(explores_, explores);
  }
  void look() {
    answer(Kind::kDone);
    ASSERT_EQ(now(), Phase::kExplore);
    EXPECT_THAT(phase().reason, HasSubstr("looking from standstill"));
    stand();
  }
  /// Then it takes a 3D scan and stands again.
  void scan_to_compare() {
    answer(Kind::kDone);
    ASSERT_EQ(now(), Phase::kScan);
    EXPECT_THAT(phase().reason, HasSubstr("a 3D scan to compare with that of the start"));
    terrain();
    ASSERT_EQ(now(), Phase::kExplore);
    stand();
  }
  void expect_drive_for_a_match() {
    look();
    scan_to_compare();
    answer(Kind::kDone);
    ASSERT_EQ(now(), Phase::kPlan);
    EXPECT_EQ(goal_.kind, PlanGoal::Kind::kRetrace);
    EXPECT_THAT(phase().reason, HasSubstr("matching again"));
    path(PlanOutcome::kFound);
    arrive();
    ASSERT_EQ(now(), Phase::kExplore);
  }
};

TEST_F(MissionAtHome, SaysWithinWhichDistanceOfTheStartItIs) {
  map_with_body_sd(0.05);
  answer(Kind::kDone);
  ASSERT_EQ(now(), Phase::kEnded);
  EXPECT_EQ(phase().outcome, MissionOutcome::kHome);
  ASSERT_TRUE(phase().home_within_m);
  EXPECT_NEAR(*phase().home_within_m, 0.25 + 2.448 * 0.05, 1e-6);  // 95 % in the plane
  EXPECT_THAT(phase().reason, HasSubstr("at home, within 0.37 m (95 %)"));
}

/// On slopes the map is displaced by more than it states.
TEST_F(MissionAtHome, IsNotSureIfRollAndPitchWereUnknown) {
  const auto drive_matched = [&](double distance_m, std::optional<Attitude> attitude) {
    ScanMatch match;
    match.odom_epoch_utime = kStart;
    match.status = ScanMatch::Status::kMatched;
    match.T_reference_body = {distance_m, 0.0, 0.0};
    match.attitude = attitude;
    mission_.add_match(match);
  };
  drive_matched(10.0, Attitude{});
  drive_matched(6.0, std::nullopt);
  map_with_body_sd(0.05);
  answer(Kind::kDone);
  ASSERT_EQ(now(), Phase::kEnded);
  EXPECT_EQ(phase().outcome, MissionOutcome::kHomeUncertain);
  EXPECT_NEAR(*phase().home_within_m, 0.25 + 2.448 * 0.05, 1e-6);
  EXPECT_THAT(phase().reason, HasSubstr("roll and pitch were unknown for 6 m"));
}

TEST_F(MissionAtHome, MatchesAgainIfThePoseIsUncertain) {
  map_with_body_sd(0.4);
  expect_drive_for_a_match();
  map_with_body_sd(0.1);
  answer(Kind::kDone);
  ASSERT_EQ(now(), Phase::kEnded);
  EXPECT_EQ(phase().outcome, MissionOutcome::kHome);
  EXPECT_NEAR(*phase().home_within_m, 0.25 + 2.448 * 0.1, 1e-6);
}

TEST_F(MissionAtHome, IsNotSureIfThePoseStaysUncertain) {
  for (const double sd_m : {0.6, 0.5}) {
    map_with_body_sd(sd_m);
    expect_drive_for_a_match();
  }
  map_with_body_sd(0.4);  // better, but the tries are used
  look();
  scan_to_compare();
  answer(Kind::kDone);
  ASSERT_EQ(now(), Phase::kEnded);
  EXPECT_EQ(phase().outcome, MissionOutcome::kHomeUncertain);
  EXPECT_NEAR(*phase().home_within_m, 0.25 + 2.448 * 0.4, 1e-6);
  EXPECT_THAT(phase().reason, HasSubstr("not sure: within 1.23 m (95 %)"));
}

TEST_F(MissionAtHome, DoesNotMatchAgainIfThatDoesNotHelp) {
  map_with_body_sd(0.5);
  expect_drive_for_a_match();
  map_with_body_sd(0.6);
  look();
  scan_to_compare();
  answer(Kind::kDone);
  ASSERT_EQ(now(), Phase::kEnded);
  EXPECT_EQ(phase().outcome, MissionOutcome::kHomeUncertain);
}

TEST_F(MissionAtHome, LooksFromStandstillBeforeItDrivesForAMatch) {
  map_with_body_sd(0.4);
  look();
  map_with_body_sd(0.1);  // mapping has matched what is seen
  answer(Kind::kDone);
  ASSERT_EQ(now(), Phase::kEnded);
  EXPECT_EQ(phase().outcome, MissionOutcome::kHome);
}

TEST_F(MissionAtHome, ComparesA3DScanWithThatOfTheStartBeforeItDrivesForAMatch) {
  map_with_body_sd(0.4);
  look();
  scan_to_compare();
  map_with_body_sd(0.05);  // mapping has matched it
  answer(Kind::kDone);
  ASSERT_EQ(now(), Phase::kEnded);
  EXPECT_EQ(phase().outcome, MissionOutcome::kHome);
}

/// The front laser looked into the mine at the start.
TEST_F(MissionAtHome, ScansWithTheLaserThatLooksAsTheFrontOneDidAtTheStart) {
  map_with_body_sd(0.4);
  look();
  scan_to_compare();
  EXPECT_EQ(phase().laser, LaserId::kFront);
}

TEST_F(MissionAtHome, ScansWithTheRearLaserIfItHasTurned) {
  heading_ = std::numbers::pi;
  tick();
  map_with_body_sd(0.4);
  look();
  scan_to_compare();
  EXPECT_EQ(phase().laser, LaserId::kRear);
}

TEST_F(MissionAtHome, EndsWithoutA3DScanThatDoesNotArrive) {
  map_with_body_sd(0.4);
  look();
  answer(Kind::kDone);
  ASSERT_EQ(now(), Phase::kScan);
  wait(31.0);
  ASSERT_EQ(now(), Phase::kExplore);
  map_with_body_sd(0.1);
  wait(6.0);
  answer(Kind::kDone);
  ASSERT_EQ(now(), Phase::kEnded);
  EXPECT_EQ(phase().outcome, MissionOutcome::kHome);
}

}  // namespace
}  // namespace adit
