// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/run_node.hpp"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/bus/typed.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

struct Params {
  double range_max_m = 30.0;
  template <class V>
  void visit(V& v) {
    v("range_max_m", range_max_m, above(0.0));
  }
};

/// Ends by a signal at its first tick.
class EndingNode {
 public:
  using Params = adit::Params;
  EndingNode(Bus& bus, const Params&) {
    bus.every(1000, [](std::int64_t) { std::raise(SIGTERM); });
  }
};

/// Breaks at its first tick.
class BreakingNode {
 public:
  using Params = adit::Params;
  BreakingNode(Bus& bus, const Params&) {
    bus.every(1000, [](std::int64_t) { throw std::runtime_error("the laser is gone"); });
  }
};

struct Outcome {
  int exit_code;
  std::string out;
  std::string err;
};

template <class Node>
Outcome run(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "program");
  std::vector<char*> argv;
  argv.reserve(arguments.size());
  for (std::string& argument : arguments) argv.push_back(argument.data());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int exit_code = run_node<Node>("mapping", static_cast<int>(argv.size()), argv.data());
  return {exit_code, testing::internal::GetCapturedStdout(),
          testing::internal::GetCapturedStderr()};
}

std::string config_file(const std::string& text) {
  static const test::ScratchFolder folder;
  std::ofstream(folder / "config.yaml") << text;
  return folder / "config.yaml";
}

TEST(RunNode, EndsCleanlyByASignal) {
  const Outcome outcome = run<EndingNode>({"--lcm-url", "memq://"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
}

TEST(RunNode, EndsWithTwoAndOneLineWhenTheNodeBreaks) {
  const Outcome outcome = run<BreakingNode>({"--lcm-url", "memq://"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err, "adit-mapping: the laser is gone\n");
}

TEST(RunNode, PrintsTheConfigurationInEffect) {
  const std::string path = config_file("mapping:\n  range_max_m: 12.5\n");
  const Outcome outcome = run<EndingNode>({"--print-config", "--config", path});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("range_max_m: 12.5"));
}

TEST(RunNode, PrintsAConfigurationThatLoadsAgain) {
  const std::string printed = run<EndingNode>({"--print-config"}).out;
  EXPECT_EQ(run<EndingNode>({"--print-config", "--config", config_file(printed)}).out, printed);
}

TEST(RunNode, RefusesAnUnknownKeyWithTwoAndOneLine) {
  const std::string path = config_file("mapping:\n  range_mx_m: 12.5\n");
  const Outcome outcome = run<EndingNode>({"--config", path});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, StartsWith("adit-mapping: " + path + ":2: "));
  EXPECT_THAT(outcome.err, HasSubstr("range_max_m"));
}

TEST(RunNode, RefusesAnUnknownSection) {
  const Outcome outcome = run<EndingNode>({"--config", config_file("scan_maching: {}\n")});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("scan_matching"));
}

TEST(RunNode, TakesTheSectionsOfOtherStages) {
  const std::string path = config_file("scan_matching: {}\nmapping: {}\nsim: {}\nvehicle: {}\n");
  EXPECT_EQ(run<EndingNode>({"--print-config", "--config", path}).exit_code, 0);
}

TEST(RunNode, RefusesAMissingFileAndAnUnknownOption) {
  EXPECT_EQ(run<EndingNode>({"--config", "/no/such/file.yaml"}).exit_code, 2);
  EXPECT_EQ(run<EndingNode>({"--speed", "2"}).exit_code, 2);
}

TEST(RunNode, SaysItsVersionAndHelps) {
  const Outcome version = run<EndingNode>({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_THAT(version.out, StartsWith("adit-mapping "));
  const Outcome help = run<EndingNode>({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, HasSubstr("--lcm-url"));
}

TEST(RunNode, SaysWhatIsWrongWithTheNetwork) {
  const Outcome outcome = run<EndingNode>({"--lcm-url", "nonsense://"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("adit-mapping: no LCM on nonsense://"));
}

}  // namespace
}  // namespace adit
