// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// The collector against commands of Slurm that answer as a test says; tests/live/slurm has a real
// cluster.
#include "tools/campaign/slurm/slurm_runner.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "common/config/config_file.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;

/// sbatch adds a line to the queue for each task, in the state that the file `state` has, unless
/// there is a file `down`, and notes that it was called. squeue runs the file `after`.
constexpr const char* kSbatch = R"sh(#!/bin/sh
cd "$(dirname "$0")"
[ "$1" = --version ] && exit
[ -e down ] && { echo "sbatch: error: Unable to contact slurm controller" >&2; exit 1; }
[ -e rejection ] && { cat rejection >&2; exit 1; }
echo call >>calls
name=$(sed -n 's/^#SBATCH --job-name=//p' "$2")
count=$(sed -n 's/^#SBATCH --array=1-//p' "$2")
for i in $(seq "$count"); do echo "9|$name|$i|$(cat state)|None" >>queue; done
)sh";

constexpr const char* kSqueue = R"sh(#!/bin/sh
cd "$(dirname "$0")"
[ "$1" = --version ] && exit
[ -e down ] && { rm down; echo "slurm_load_jobs error: Unable to contact" >&2; exit 1; }
[ ! -e queue ] || cat queue
[ ! -e after ] || sh after
)sh";

constexpr const char* kScancel = R"sh(#!/bin/sh
cd "$(dirname "$0")"
[ "$1" = --version ] || echo "$@" >>cancelled
)sh";

class SlurmRunnerTest : public testing::Test {
 protected:
  SlurmRunnerTest() {
    command("sbatch", kSbatch);
    command("squeue", kSqueue);
    command("scancel", kScancel);
    setenv("PATH", (folder_.path().string() + ":" + path_).c_str(), 1);
    const ConfigFile file =
        ConfigFile::parse("campaign: {command: 'sh {n}'}\nmatrix: {n: [1, 2]}\n", "c.yaml");
    plan_ = make_plan(load_campaign(file), expand_matrix(file, "/"), "c.yaml", "/", "/");
    fs::create_directories(files_.units());
    runner_.programs = fs::path(ADIT_WATCH).parent_path();
    runner_.queue_period_s = 0.02;
    runner_.notify = [this](const std::string& message) { messages_.push_back(message); };
  }
  ~SlurmRunnerTest() override { setenv("PATH", path_.c_str(), 1); }

  void command(const std::string& name, const std::string& text) {
    write(name, text);
    fs::permissions(folder_ / name, fs::perms::owner_all);
  }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }

  /// As a task does.
  void finish(const CampaignUnit& unit) const {
    fs::create_directories(files_.unit(unit.id));
    UnitResult result;
    result.id = unit.id;
    result.state = UnitState::kEnded;
    result.exit_code = 0;
    write_result(result, files_.result(unit.id));
  }

  /// Results as "state: reason", in the order of units.
  std::vector<std::string> run() {
    std::map<int, std::string> results;
    runner_.run(plan_, {&plan_.units[0], &plan_.units[1]}, files_,
                [&](const CampaignUnit& unit, const UnitResult& result) {
                  results[unit.number] = name_of(result.state) + ": " + result.reason;
                  return true;
                });
    std::vector<std::string> texts;
    for (const auto& [number, text] : results) texts.push_back(text);
    return texts;
  }

  [[nodiscard]] std::size_t submits() const {
    return test::contents(folder_ / "calls").size() / std::string("call\n").size();
  }

  test::ScratchFolder folder_;
  std::string path_ = std::getenv("PATH");
  CampaignFolder files_{folder_ / "out"};
  CampaignPlan plan_;
  SlurmRunner runner_;
  std::vector<std::string> messages_;
};

TEST_F(SlurmRunnerTest, TakesLimitsThatSlurmEnforced) {
  write("state", "OUT_OF_MEMORY");
  EXPECT_THAT(run(), ElementsAre("memory limit: Slurm: OUT_OF_MEMORY",
                                 "memory limit: Slurm: OUT_OF_MEMORY"));
  EXPECT_EQ(submits(), 1U);
}

TEST_F(SlurmRunnerTest, SubmitsAUnitThreeTimesBeforeItIsLost) {
  write("state", "FAILED");
  const std::string lost = "lost: 3 tasks of Slurm ended without a result, the last one: FAILED";
  EXPECT_THAT(run(), ElementsAre(lost, lost));
  EXPECT_EQ(submits(), 3U);
}

TEST_F(SlurmRunnerTest, DoesNotSubmitWhatTheUserCancelled) {
  write("state", "CANCELLED");
  EXPECT_THAT(run(), ElementsAre("lost: Slurm: CANCELLED", "lost: Slurm: CANCELLED"));
  EXPECT_EQ(submits(), 1U);
}

TEST_F(SlurmRunnerTest, WaitsForAControllerThatDoesNotAnswer) {
  write("down", "");
  write("state", "TIMEOUT");
  EXPECT_THAT(run(), ElementsAre("time limit: Slurm: TIMEOUT", "time limit: Slurm: TIMEOUT"));
  EXPECT_THAT(messages_, ElementsAre("the controller of Slurm does not answer; waiting for it"));
}

/// The tasks of a collector that ended go their course, and their results count.
TEST_F(SlurmRunnerTest, LeavesTasksOfAnEarlierRunInTheQueue) {
  write("state", "RUNNING");
  int stop[2];
  ASSERT_EQ(pipe(stop), 0);
  ASSERT_EQ(::write(stop[1], "x", 1), 1);
  runner_.stop_descriptor = stop[0];
  EXPECT_THAT(run(), IsEmpty());
  EXPECT_EQ(submits(), 1U);
  close(stop[0]);
  close(stop[1]);
  runner_.stop_descriptor = -1;
  for (const CampaignUnit& unit : plan_.units) finish(unit);
  fs::rename(files_.units(), folder_ / "done");
  fs::create_directories(files_.units());
  write("after", "mv done/* out/units 2>/dev/null; true");  // once
  EXPECT_THAT(run(), ElementsAre("ended: ", "ended: "));
  EXPECT_EQ(submits(), 1U);
  EXPECT_EQ(test::contents(folder_ / "cancelled"), "9\n");  // as the fake tasks still run
}

TEST_F(SlurmRunnerTest, ReportsWhySlurmRejectsTheScript) {
  write("rejection", "sbatch: error: invalid partition specified: none\nmore\n");
  EXPECT_THAT([&] { run(); }, testing::ThrowsMessage<std::runtime_error>(
                                  "sbatch: sbatch: error: invalid partition specified: none"));
}

}  // namespace
}  // namespace adit
