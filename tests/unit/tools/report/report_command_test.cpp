// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"
#include "tests/unit/tools/adit/outcome.hpp"
#include "tests/unit/tools/report/mission_log.hpp"

namespace adit {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;

TEST(ReportCommand, SaysWhereThePageIsAndHowTheMissionWent) {
  const test::ScratchFolder folder;
  test::write_mission_log(folder / "run.lcmlog");
  const Outcome outcome = adit({"report", folder / "run.lcmlog", "--out", folder / "out"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("out/mission.html: The robot came home."));
  EXPECT_EQ(outcome.err, "");
}

TEST(ReportCommand, EndsWithOneLineForAnEmptyLog) {
  const test::ScratchFolder folder;
  std::ofstream(folder / "empty.lcmlog").close();
  const Outcome outcome = adit({"report", folder / "empty.lcmlog", "--out", folder / "out"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, MatchesRegex("adit: no event in [^\n]*empty.lcmlog\n"));
}

}  // namespace
}  // namespace adit
