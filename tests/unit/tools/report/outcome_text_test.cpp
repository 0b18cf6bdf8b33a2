// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "tools/report/mission_facts.hpp"

namespace adit {
namespace {

MissionFacts at_home(bool complete, const StubCounts& stubs) {
  MissionFacts facts;
  facts.last.emplace();
  facts.last->outcome = MissionOutcome::kHome;
  facts.last->complete = complete;
  facts.stubs = stubs;
  return facts;
}

TEST(OutcomeText, SaysOfAnExploredMineWhatIsBlocked) {
  EXPECT_EQ(outcome_text(at_home(true, {.found = 5, .closed = 5, .blocked = 1})),
            "The robot came home. It explored the mine: every one of the 5 openings that it saw is "
            "closed, with evidence; 1 is blocked.");
  EXPECT_EQ(outcome_text(at_home(true, {.found = 2, .closed = 2})),
            "The robot came home. It explored the mine: every one of the 2 openings that it saw is "
            "closed, with evidence.");
}

TEST(OutcomeText, SaysOfTheOthersWhatIsOpenAndWhatIsDoubtful) {
  EXPECT_EQ(
      outcome_text(
          at_home(false, {.found = 7, .closed = 3, .open = 4, .blocked = 2, .doubtful = 1})),
      "The robot came home. Of 7 openings, 3 are left open, 1 is given up, though nobody saw what "
      "blocks the way, 2 are blocked.");
}

}  // namespace
}  // namespace adit
