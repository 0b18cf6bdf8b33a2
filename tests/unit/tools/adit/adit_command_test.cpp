// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/pose_graph/g2o_file.hpp"
#include "tests/support/graphs/synthetic_graphs.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/tools/adit/command_result.hpp"
#include "tools/carmen/carmen_reader.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class AditCommand : public testing::Test {
 protected:
  [[nodiscard]] std::string at(const std::string& name) const { return folder_ / name; }
  [[nodiscard]] std::string contents(const std::string& name) const {
    return test::contents(at(name));
  }

 private:
  test::ScratchFolder folder_;
};

TEST_F(AditCommand, DescribesEveryCommandInItsHelp) {
  EXPECT_EQ(adit({"--help"}).exit_code, 0);
  for (const std::vector<std::string>& command : {std::vector<std::string>{"import", "carmen"},
                                                  {"import", "bag"},
                                                  {"import", "clouds"},
                                                  {"eval", "map"},
                                                  {"eval", "relations"},
                                                  {"drive"},
                                                  {"logs"},
                                                  {"mission"},
                                                  {"order"},
                                                  {"reload"},
                                                  {"report"},
                                                  {"map"},
                                                  {"optimize"},
                                                  {"plan"},
                                                  {"ps"},
                                                  {"restart"},
                                                  {"sample"},
                                                  {"scan"},
                                                  {"sim"},
                                                  {"spy"},
                                                  {"volume"},
                                                  {"start"},
                                                  {"stop"},
                                                  {"completion", "bash"}}) {
    std::vector<std::string> arguments = command;
    arguments.emplace_back("--help");
    const CommandResult outcome = adit(arguments);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.out, AllOf(HasSubstr("Usage: adit " + command[0]),
                                   HasSubstr("\nExit codes:\n"), HasSubstr("\nExamples:\n")));
  }
}

TEST_F(AditCommand, PrintsItsVersion) { EXPECT_THAT(adit({"--version"}).out, StartsWith("adit ")); }

TEST_F(AditCommand, ReportsInvalidUsageInOneLineWithExitCodeTwo) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"imprt"},
        {"import"},
        {"completion", "zsh"},
        {"sample"},
        {"sample", at("x.txt")},
        {"import", "carmen", at("missing"), at("out")},
        {"import", "bag", at("missing"), at("out")},
        {"import", "bag", at("missing")},
        {"import", "clouds", at("missing"), at("out")},
        {"export", at("missing"), "--rosbag2", at("out")},
        {"sample", "/nonexistent/x.log"},
        {"sample", at("x.log"), "--length-m", "0"},
        {"sample", at("x.log"), "--world", "flat"},
        {"map", at("missing"), "--out", at("map")},
        {"volume", at("missing"), "--out", at("volume")},
        {"optimize", at("missing")},
        {"optimize", at("missing"), "--loops", "none"},
        {"optimize", at("missing"), "--loops", "lazy"},
        {"optimize", at("missing"), "--loops", "lazy", "--order", "random"},
        {"optimize", at("missing"), "--order", "threshold"},
        {"ps", "--socket", at("missing")},
        {"start", "--socket", at("missing")},
        {"start", "x", "--all", "--socket", at("missing")},
        {"stop", "x", "--socket", at("missing")},
        {"logs", "x", "--socket", at("missing")},
        {"logs"},
        {"eval", "map", at("missing")},
        {"eval", "map", at("missing"), "--world", "straight"},
        {"eval", "relations", at("missing"), at("missing")}}) {
    const CommandResult outcome = adit(arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, StartsWith("adit: "));
    EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
  }
  EXPECT_EQ(adit({}).exit_code, 2);
}

constexpr const char* kEdge = "EDGE_SE2 3 4 1 0 0 1 0 0 1 0 1\n";

TEST_F(AditCommand, OrderNamesItsChoices) {
  const CommandResult outcome = adit({"order", "fly"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("fly"), HasSubstr("{pause,resume,return,stop}; see adit --help")));
}

TEST_F(AditCommand, OptimizesAGraphAndWritesItsPoses) {
  std::ofstream(at("g.g2o")) << kEdge << "EDGE_SE2 3 4 2 0 0 1 0 0 1 0 1\n";
  const CommandResult outcome = adit({"optimize", at("g.g2o"), "--out", at("best.g2o")});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("\"objective\": 0.5"), HasSubstr("\"total\":")));
  EXPECT_THAT(contents("best.g2o"), HasSubstr("VERTEX_SE2 4 1.5 0 0\n"));
}

TEST_F(AditCommand, OptimizeReportsTheInvalidLineOrNode) {
  std::ofstream(at("line.g2o")) << kEdge << "EDGE_SE2 4 5 1 0\n";
  EXPECT_THAT(adit({"optimize", at("line.g2o")}).err, HasSubstr("line.g2o:2: "));
  std::ofstream(at("apart.g2o")) << kEdge << "VERTEX_SE2 3 0 0 0\nVERTEX_SE2 4 0 0 0\n"
                                 << "VERTEX_SE2 9 0 0 0\n";
  const CommandResult outcome = adit({"optimize", at("apart.g2o")});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("apart.g2o: no chain of constraints links pose 9"));
}

/// Two laps of a square trajectory and one wrong loop closure.
G2oGraph two_laps() {
  G2oGraph file{test::square_trajectory_graph(160, 20, 0.05), {}};
  for (long id = 0; id < 160; ++id) file.ids.push_back(id);
  file.graph.constraints.push_back({10, 130, {}, 100.0 * Eigen::Matrix3d::Identity()});
  return file;
}

TEST_F(AditCommand, OptimizeRejectsAWrongLoopClosure) {
  const G2oGraph file = two_laps();
  write_g2o(file, at("g.g2o"));
  for (const char* order : {"best_first", "threshold"}) {
    const CommandResult outcome = adit(
        {"optimize", at("g.g2o"), "--loops", "lazy", "--order", order, "--out", at("good.g2o")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, testing::IsEmpty());
    EXPECT_THAT(outcome.out, AllOf(HasSubstr("\"loops\": 81,"), HasSubstr("\"association\":"),
                                   HasSubstr("\"loops_rejected\": [\n    [10, 130]\n  ]")));
    const G2oGraph good = read_g2o(at("good.g2o"));
    EXPECT_EQ(good.ids, file.ids);
    EXPECT_EQ(good.graph.constraints.size(), file.graph.constraints.size() - 1);
    for (std::size_t i = 0; i < good.graph.poses.size(); ++i) {
      const Pose2 apart = between(good.graph.poses[i], file.graph.poses[i]);
      EXPECT_LT(apart.translation().norm(),
                1.0);  // the wrong loop closure causes an error of tens of metres
    }
  }
}

TEST_F(AditCommand, OptimizeNamesTheBridgesOfGapsInTheOdometry) {
  std::ofstream(at("gap.g2o")) << kEdge << "EDGE_SE2 3 9 1 0 0 1 0 0 1 0 1\n";
  const CommandResult outcome = adit({"optimize", at("gap.g2o"), "--loops", "lazy"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(
      outcome.err,
      HasSubstr("gap.g2o: 1 gap in the odometry, bridged by trusted constraints: 3 to 9\n"));
  EXPECT_THAT(outcome.out, HasSubstr("\"bridges_trusted\": [\n    [3, 9]\n  ]"));
  const CommandResult all = adit({"optimize", at("gap.g2o")});
  EXPECT_EQ(all.exit_code, 0);
  EXPECT_THAT(all.err, testing::IsEmpty());
}

/// Graphs that have no optimum: one line each, with both kinds of association.
TEST_F(AditCommand, OptimizeRejectsGraphsWithoutAnOptimumInOneLine) {
  std::ofstream(at("apart.g2o")) << kEdge << "EDGE_SE2 7 8 1 0 0 1 0 0 1 0 1\n";
  std::ofstream(at("free.g2o")) << kEdge << "EDGE_SE2 4 5 1 0 0 1 0 0 1 0 0\n";
  std::ofstream(at("indefinite.g2o")) << kEdge << "EDGE_SE2 4 5 1 0 0 1 2 0 1 0 1\n";
  const std::map<std::string, std::string> reasons = {
      {"apart.g2o", "no chain of constraints links pose 7 with the first"},
      {"free.g2o", "the constraints leave pose 5 free to move"},
      {"indefinite.g2o", "indefinite.g2o:2: the information has the negative eigenvalue"}};
  for (const char* loops : {"all", "lazy"}) {
    for (const auto& [file, reason] : reasons) {
      const CommandResult outcome = adit({"optimize", at(file), "--loops", loops});
      EXPECT_EQ(outcome.exit_code, 2);
      EXPECT_THAT(outcome.err, HasSubstr(reason));
      EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
    }
  }
}

TEST_F(AditCommand, SampleIsReproducibleAndCanBeImported) {
  ASSERT_EQ(adit({"sample", at("a.log"), "--truth", at("a.tum")}).exit_code, 0);
  ASSERT_EQ(adit({"sample", at("b.log")}).exit_code, 0);
  EXPECT_EQ(contents("a.log"), contents("b.log"));

  const CommandResult import = adit({"import", "carmen", at("a.log"), at("a.lcmlog")});
  EXPECT_EQ(import.exit_code, 0);
  const auto scans = std::to_string(read_tum(at("a.tum")).size());
  EXPECT_THAT(import.out, HasSubstr(scans + " scans, 0 odometry lines; 0 of " + scans));
  EXPECT_GT(contents("a.lcmlog").size(), 1'000'000U);

  ASSERT_EQ(adit({"sample", at("c.lcmlog"), "--seed", "2", "--half-degree"}).exit_code, 0);
  EXPECT_GT(contents("c.lcmlog").size(), contents("a.lcmlog").size());

  ASSERT_EQ(adit({"sample", at("d.log"), "--length-m", "10"}).exit_code, 0);
  EXPECT_THAT(contents("a.log"), StartsWith(contents("d.log")));
}

TEST_F(AditCommand, SampleSupportsSeveralWorlds) {
  const auto sample = [&](const std::string& name, std::vector<std::string> options) {
    options.insert(options.begin(), {"sample", at(name), "--length-m", "5"});
    EXPECT_EQ(adit(options).exit_code, 0);
    return contents(name);
  };
  const std::string by_default = sample("default.log", {});
  EXPECT_EQ(by_default, sample("same.log", {"--world", "sample"}));
  const std::string parallel = sample("parallel.log", {"--world", "parallel"});
  EXPECT_NE(parallel, by_default);
  EXPECT_NE(parallel, sample("biased.log", {"--world", "parallel", "--yaw-bias-deg-per-m", "1"}));
  EXPECT_NE(parallel, sample("bent.log", {"--world", "parallel", "--bearing-error-percent", "2"}));
  EXPECT_NE(parallel, sample("grid.log", {"--world", "grid"}));
}

TEST_F(AditCommand, MapsASample) {
  ASSERT_EQ(adit({"sample", at("a.log"), "--truth", at("a.tum"), "--length-m", "10"}).exit_code, 0);
  const CommandResult outcome = adit({"map", at("a.log"), "--out", at("map")});
  EXPECT_EQ(outcome.exit_code, 0);
  const auto scans = std::to_string(read_tum(at("a.tum")).size());
  EXPECT_THAT(outcome.out, HasSubstr(scans + " scans over "));
  EXPECT_THAT(contents("map/summary.json"), HasSubstr("\"total\": " + scans));
}

TEST_F(AditCommand, ImportReportsSkippedLines) {
  std::ofstream(at("in.log")) << "FLASER 2 1 1 0 0 0 0 0 0 5 h 5\nODOM 0 0 0 0 0 0 0 h 0\n";
  const CommandResult outcome = adit({"import", "carmen", at("in.log"), at("out.lcmlog")});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("skipped line 2: timestamp not positive"));
  EXPECT_THAT(outcome.out, HasSubstr("1 of 2 lines skipped"));
}

TEST_F(AditCommand, ImportWritesNoLogWithoutReadings) {
  std::ofstream(at("in.log")) << "PARAM a b\n";
  EXPECT_EQ(adit({"import", "carmen", at("in.log"), at("out.lcmlog")}).exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(at("out.lcmlog")));
  EXPECT_EQ(adit({"import", "carmen", at("in.log"), at("in.log")}).exit_code, 2);
  EXPECT_EQ(contents("in.log"), "PARAM a b\n");
}

TEST_F(AditCommand, EvalRelationsPrintsJson) {
  std::ofstream(at("a.relations")) << "1 2 1 0 0 0 0 0\n1 9 0 0 0 0 0 0\n";
  std::ofstream(at("a.tum")) << "1 0 0 0 0 0 0 1\n2 1.5 0 0 0 0 0 1\n";
  const CommandResult outcome = adit({"eval", "relations", at("a.relations"), at("a.tum")});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("\"used\": 1"), HasSubstr("\"outside_trajectory\": 1"),
                                 HasSubstr("\"mean\": 0.5")));
}

}  // namespace
}  // namespace adit
