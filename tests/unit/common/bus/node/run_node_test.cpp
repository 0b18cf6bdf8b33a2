// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/node/run_node.hpp"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/bus/typed_messages.hpp"
#include "common/files/file_error.hpp"
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

/// Raises SIGTERM at its first tick.
class TerminatingNode {
 public:
  using Params = adit::Params;
  TerminatingNode(Bus& bus, const Params&) {
    bus.create_timer(1000, [](std::int64_t) { std::raise(SIGTERM); });
  }
};

/// Throws at its first tick.
class ThrowingNode {
 public:
  using Params = adit::Params;
  ThrowingNode(Bus& bus, const Params&) {
    bus.create_timer(1000, [](std::int64_t) { throw FileError("the laser is gone"); });
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

TEST(RunNode, ExitsCleanlyOnASignal) {
  const Outcome outcome = run<TerminatingNode>({"--lcm-url", "memq://"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
}

TEST(RunNode, ExitsWithTwoAndOneLineOnAnException) {
  const Outcome outcome = run<ThrowingNode>({"--lcm-url", "memq://"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err, "adit-mapping: the laser is gone\n");
}

TEST(RunNode, PrintsTheConfigurationInEffect) {
  const std::string path = config_file("mapping:\n  range_max_m: 12.5\n");
  const Outcome outcome = run<TerminatingNode>({"--print-config", "--config", path});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("range_max_m: 12.5"));
}

TEST(RunNode, PrintsAConfigurationThatLoadsAgain) {
  const std::string printed = run<TerminatingNode>({"--print-config"}).out;
  EXPECT_EQ(run<TerminatingNode>({"--print-config", "--config", config_file(printed)}).out,
            printed);
}

TEST(RunNode, RejectsAnUnknownKeyWithTwoAndOneLine) {
  const std::string path = config_file("mapping:\n  range_mx_m: 12.5\n");
  const Outcome outcome = run<TerminatingNode>({"--config", path});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, StartsWith("adit-mapping: " + path + ":2: "));
  EXPECT_THAT(outcome.err, HasSubstr("range_max_m"));
}

TEST(RunNode, RejectsAnUnknownSection) {
  const Outcome outcome = run<TerminatingNode>({"--config", config_file("scan_maching: {}\n")});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("scan_matching"));
}

TEST(RunNode, AcceptsSectionsOfOtherStages) {
  const std::string path = config_file("scan_matching: {}\nmapping: {}\nsim: {}\nvehicle: {}\n");
  EXPECT_EQ(run<TerminatingNode>({"--print-config", "--config", path}).exit_code, 0);
}

TEST(RunNode, RejectsAMissingFileAndAnUnknownOption) {
  EXPECT_EQ(run<TerminatingNode>({"--config", "/no/such/file.yaml"}).exit_code, 2);
  EXPECT_EQ(run<TerminatingNode>({"--speed", "2"}).exit_code, 2);
}

TEST(RunNode, PrintsVersionAndHelp) {
  const Outcome version = run<TerminatingNode>({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_THAT(version.out, StartsWith("adit-mapping "));
  const Outcome help = run<TerminatingNode>({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, HasSubstr("--lcm-url"));
}

TEST(RunNode, RunsADriverForTheDeviceOfItsArgument) {
  const auto run = [](std::vector<std::string> words) {
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    const auto configure = [](const ConfigFile& file, const std::string& stage) {
      return configure_node<TerminatingNode>(stage, file);
    };
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const int code = run_stage("sick_lms2xx", {"front", "rear"}, configure,
                               static_cast<int>(argv.size()), argv.data());
    const std::string out = testing::internal::GetCapturedStdout();
    const std::string error = testing::internal::GetCapturedStderr();
    return std::to_string(code) + " " + out + error;
  };
  EXPECT_THAT(run({"driver", "rear", "--print-config"}), StartsWith("0 sick_lms2xx_rear:"));
  EXPECT_THAT(run({"driver", "--print-config"}), StartsWith("2 adit-sick_lms2xx: DEVICE"));
  EXPECT_THAT(run({"driver", "left", "--print-config"}), HasSubstr("left"));
}

TEST(RunNode, ReportsNetworkErrors) {
  const Outcome outcome = run<TerminatingNode>({"--lcm-url", "nonsense://"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("adit-mapping: cannot open LCM on nonsense://"));
}

}  // namespace
}  // namespace adit
