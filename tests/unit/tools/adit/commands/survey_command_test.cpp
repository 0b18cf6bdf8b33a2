// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// adit survey on the command line: exit codes and one-line errors.
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"
#include "tests/unit/tools/adit/command_result.hpp"

namespace adit {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class SurveyCommand : public testing::Test {
 protected:
  [[nodiscard]] std::string at(const std::string& name) const { return folder_ / name; }

  void expect_error(const std::vector<std::string>& arguments, const std::string& text) const {
    const CommandResult outcome = adit(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << text;
    EXPECT_THAT(outcome.err, StartsWith("adit"));
    EXPECT_THAT(outcome.err, HasSubstr(text));
    EXPECT_FALSE(std::filesystem::exists(at("out")));
  }

  test::ScratchFolder folder_;
};

TEST_F(SurveyCommand, RejectsWhatIsMissing) {
  expect_error({"survey"}, "MISSION is required");
  expect_error({"survey", at("mission")}, "--out is required");
  expect_error({"survey", at("mission"), "--out", at("out")}, "no such file or folder");
  expect_error({"survey", "compare", at("a")}, "NEWER is required");
  expect_error({"survey", "compare", at("a"), at("b"), "--out", at("out")}, "a/survey.gpkg");
}

TEST_F(SurveyCommand, RejectsBadOptions) {
  expect_error({"survey", at("mission"), "--out", at("out"), "--sheet", "A5"}, "A5");
  expect_error({"survey", at("mission"), "--out", at("out"), "--water-level", "high"}, "high");
  expect_error({"survey", at("mission"), "--out", at("out"), "--every", "0"}, "--every");
}

TEST_F(SurveyCommand, TeachesComparisons) {
  const CommandResult help = adit({"survey", "compare", "--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, HasSubstr("--by-coordinates"));
  EXPECT_THAT(help.out, HasSubstr("change.tif"));
}

}  // namespace
}  // namespace adit
