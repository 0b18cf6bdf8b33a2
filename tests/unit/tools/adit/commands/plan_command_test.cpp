// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// adit scan and adit plan on the command line: files, exit codes and one-line errors.
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"
#include "tests/unit/tools/adit/command_result.hpp"

namespace adit {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class PlanCommand : public testing::Test {
 protected:
  [[nodiscard]] std::string at(const std::string& name) const { return folder_ / name; }

  [[nodiscard]] CommandResult plan(const std::string& input,
                                   std::vector<std::string> options = {}) const {
    options.insert(options.begin(), {"plan", at(input), "--out", at("out")});
    return adit(options);
  }

  void expect_error(const CommandResult& outcome, const std::string& text) const {
    EXPECT_EQ(outcome.exit_code, 2) << text;
    EXPECT_THAT(outcome.err, StartsWith("adit: "));
    EXPECT_THAT(outcome.err, HasSubstr(text));
    EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(at("out")));
  }

  test::ScratchFolder folder_;
};

TEST_F(PlanCommand, PlansOnAScanOfASimulatedMine) {
  ASSERT_EQ(adit({"scan", "mathies", "--out", at("scan.lcmlog")}).exit_code, 0);
  const CommandResult outcome = plan("scan.lcmlog");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("found: A path was found."));
  EXPECT_THAT(outcome.out, HasSubstr("scan to path"));
  EXPECT_TRUE(std::filesystem::exists(at("out/sheet.png")));
}

/// 308 m into Mathies, where Groundhog turned back.
TEST_F(PlanCommand, ReturnsThreeInFrontOfTheBrokenBeam) {
  ASSERT_EQ(adit({"scan", "mathies", "--at", "308,5.84,-4.4", "--out", at("s.lcmlog")}).exit_code,
            0);
  const CommandResult outcome = plan("s.lcmlog");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.out, HasSubstr("No path: "));
  EXPECT_EQ(outcome.err, "");
  EXPECT_TRUE(std::filesystem::exists(at("out/plan.png")));
  EXPECT_EQ(plan("s.lcmlog", {"--all"}).exit_code, 3);
  EXPECT_TRUE(std::filesystem::exists(at("out/scan_1/path.json")));
  const CommandResult list = adit({"plan", at("s.lcmlog"), "--list"});
  EXPECT_EQ(list.exit_code, 0);
  EXPECT_THAT(list.out, HasSubstr("86367"));
}

TEST_F(PlanCommand, PrintsThePlanCommandForAPointCloud) {
  const CommandResult scan = adit({"scan", "mathies", "--out", at("scan.ply")});
  ASSERT_EQ(scan.exit_code, 0);
  EXPECT_THAT(scan.out, HasSubstr("--laser-at "));
  const std::string origin = scan.out.substr(scan.out.find("--laser-at ") + 11);
  const CommandResult outcome = plan("scan.ply", {"--laser-at", origin.substr(0, origin.find(' ')),
                                                  "--vehicle-at", "0,0", "--ground-m", "0"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
}

TEST_F(PlanCommand, RejectsUnusableInputInOneLine) {
  std::ofstream(at("few.xyz")) << "1 2 3\n";
  std::ofstream(at("bad.xyz")) << "1 2 3\n4 5\n";
  std::ofstream(at("empty.ply")) << "";
  std::ofstream(at("empty.lcmlog")) << "";
  expect_error(plan("none.ply"), "none.ply");
  expect_error(plan("few.xyz"), "no ground points near the vehicle");
  expect_error(plan("bad.xyz"), "bad.xyz: line 2: ");
  expect_error(plan("empty.ply"), "is empty");
  expect_error(plan("empty.lcmlog"), "no 3D scan");
  expect_error(plan("few.xyz", {"--up", "w"}), "--up");
  expect_error(plan("few.xyz", {"--laser-at", "1,2"}), "--laser-at");
  expect_error(plan("few.xyz", {"--scan", "1"}), "a point cloud is one scan");
  expect_error(plan("few.xyz", {"--goal", "1,2", "--direction-deg", "3"}), "excludes");
  expect_error(plan("few.xyz", {"--distance-m", "-1"}), "--distance-m");
  expect_error(plan("few.xyz", {"--estimator", "best"}), "--estimator");
  expect_error(plan("few.xyz", {"--config", at("none.yaml")}), "none.yaml");
  expect_error(adit({"plan", at("few.xyz")}), "--out");
  expect_error(adit({"plan", at("few.xyz"), "--list"}), "requires a log");
  expect_error(adit({"scan", "mathies", "--at", "0,40,0", "--out", at("out")}), "no floor");
  expect_error(adit({"scan", "mathies", "--out", at("out")}), ".lcmlog or .ply");
}

TEST_F(PlanCommand, RejectsMalformedNumberLists) {
  std::ofstream(at("few.xyz")) << "1 2 3\n";
  for (const char* text : {"", "1", "1,2,3,4", "1,", ",1", "1,x", "1, 2", "1,nan", "1,inf"}) {
    expect_error(plan("few.xyz", {std::string("--goal=") + text}), "--goal");
  }
  for (const char* text : {"--goal=1.5,-2", "--goal=1,2,3e1"}) {
    expect_error(plan("few.xyz", {text}), "no ground points");  // the list is accepted
  }
}

}  // namespace
}  // namespace adit
