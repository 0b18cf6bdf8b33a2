// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/mission_statistics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace adit {
namespace {

MissionStatistics mission_at_home(bool complete, const FrontierCounts& frontiers) {
  MissionStatistics statistics;
  statistics.last.emplace();
  statistics.last->outcome = MissionOutcome::kHome;
  statistics.last->complete = complete;
  statistics.last->distance_travelled_m = 20.0;
  statistics.frontiers = frontiers;
  return statistics;
}

TEST(MissionStatistics, OutcomeOfACompleteExplorationHasBlockedFrontiers) {
  EXPECT_EQ(outcome_text(mission_at_home(true, {.found = 5, .closed = 5, .blocked = 1})),
            "The robot returned home. The exploration is complete: 5 of 5 frontiers are closed "
            "(1 blocked).");
  EXPECT_EQ(outcome_text(mission_at_home(true, {.found = 2, .closed = 2})),
            "The robot returned home. The exploration is complete: 2 of 2 frontiers are closed.");
}

TEST(MissionStatistics, OutcomeSaysHowSureTheRobotIsOfHome) {
  MissionStatistics statistics = mission_at_home(true, {.found = 2, .closed = 2});
  statistics.last->home_within_m = 0.214;
  EXPECT_THAT(outcome_text(statistics),
              testing::StartsWith("The robot returned home, within 0.21 m (95 %)."));
  statistics.last->outcome = MissionOutcome::kHomeUncertain;
  statistics.last->home_within_m = 1.4;
  EXPECT_THAT(outcome_text(statistics),
              testing::StartsWith("The robot is at home by its own estimate, but not sure: within "
                                  "1.40 m (95 %)."));
}

TEST(MissionStatistics, OutcomeSaysThatTheRobotDidNotLeaveTheStart) {
  MissionStatistics statistics = mission_at_home(false, {});
  statistics.last->distance_travelled_m = 0.1;
  statistics.last->reason = "the robot is at home: no path into the mine was found: No path.";
  EXPECT_EQ(outcome_text(statistics),
            "The robot did not leave the start: the robot is at home: no path into the mine was "
            "found: No path.");
}

TEST(MissionStatistics, OutcomeOfAnIncompleteExplorationHasOpenFrontiers) {
  EXPECT_EQ(outcome_text(mission_at_home(
                false, {.found = 7, .closed = 3, .open = 4, .blocked = 2, .unconfirmed = 1})),
            "The robot returned home. The exploration is incomplete: 3 of 7 frontiers are closed "
            "(2 blocked), 3 open, 1 abandoned without evidence of a blockage.");
}

TEST(MissionStatistics, OutcomeSaysWhereTheMapContradictsItself) {
  MissionStatistics statistics = mission_at_home(true, {.found = 2, .closed = 2});
  statistics.contradictory = {{0, 1, 20.0, 35.0, 0, 0, {"contradictory"}, {4, 5, 6}}};
  EXPECT_THAT(
      outcome_text(statistics),
      testing::AllOf(
          testing::HasSubstr("2 of 2 frontiers are closed. The map contradicts itself over 15"),
          testing::EndsWith(": 1 doubtful stretch: at 20 to 35 m (contradictory).")));
}

}  // namespace
}  // namespace adit
