// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/mission_statistics.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

MissionStatistics mission_at_home(bool complete, const FrontierCounts& frontiers) {
  MissionStatistics statistics;
  statistics.last.emplace();
  statistics.last->outcome = MissionOutcome::kHome;
  statistics.last->complete = complete;
  statistics.frontiers = frontiers;
  return statistics;
}

TEST(MissionStatistics, SaysOfAnExploredMineWhatIsBlocked) {
  EXPECT_EQ(outcome_text(mission_at_home(true, {.found = 5, .closed = 5, .blocked = 1})),
            "The robot came home. It explored the mine: every one of the 5 openings that it saw is "
            "closed, with evidence; 1 is blocked.");
  EXPECT_EQ(outcome_text(mission_at_home(true, {.found = 2, .closed = 2})),
            "The robot came home. It explored the mine: every one of the 2 openings that it saw is "
            "closed, with evidence.");
}

TEST(MissionStatistics, SaysOfTheOthersWhatIsOpenAndWhatIsDoubtful) {
  EXPECT_EQ(
      outcome_text(mission_at_home(
          false, {.found = 7, .closed = 3, .open = 4, .blocked = 2, .unconfirmed = 1})),
      "The robot came home. Of 7 openings, 3 are left open, 1 is given up, though nobody saw what "
      "blocks the way, 2 are blocked.");
}

}  // namespace
}  // namespace adit
