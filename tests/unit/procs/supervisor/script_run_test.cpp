// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/management/script_run.hpp"

#include <map>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/process_list/parser.hpp"

namespace adit {
namespace {

using Kind = ScriptAction::Kind;
using testing::ElementsAre;

constexpr std::int64_t kMs = 1000;

class ScriptRunTest : public testing::Test {
 protected:
  static ProcessList list_with(const std::string& script) {
    return parse_process_list(R"(group "g" { cmd "a" { exec = "x"; } cmd "b" { exec = "x"; } }
                                 cmd "c" { exec = "x"; } )" +
                                  script,
                              "list");
  }

  std::optional<ScriptChange> advance(ScriptRun& run, std::int64_t now_us) {
    return run.advance(now_us, [this](const std::string& id) { return standings_[id]; });
  }

  std::map<std::string, ProcessState> standings_;
};

TEST_F(ScriptRunTest, ChangesTheNamedCommandsInOrder) {
  const ProcessList list =
      list_with(R"(script "s" { start group "g"; stop cmd "c"; restart everything; })");
  ScriptRun run(list, "s", 10.0);
  const auto first = advance(run, 0);
  EXPECT_EQ(first->kind, Kind::kStart);
  EXPECT_THAT(first->ids, ElementsAre("a", "b"));
  const auto second = advance(run, 0);
  EXPECT_EQ(second->kind, Kind::kStop);
  EXPECT_THAT(second->ids, ElementsAre("c"));
  const auto third = advance(run, 0);
  EXPECT_EQ(third->kind, Kind::kRestart);
  EXPECT_THAT(third->ids, ElementsAre("a", "b", "c"));
  EXPECT_FALSE(advance(run, 0));
  EXPECT_TRUE(run.is_finished());
  EXPECT_EQ(run.failure(), "");
}

TEST_F(ScriptRunTest, WaitsForATime) {
  const ProcessList list = list_with(R"(script "s" { wait ms 500; start cmd "c"; })");
  ScriptRun run(list, "s", 10.0);
  EXPECT_FALSE(advance(run, 1000 * kMs));
  EXPECT_FALSE(advance(run, 1499 * kMs));
  EXPECT_TRUE(advance(run, 1500 * kMs));
}

TEST_F(ScriptRunTest, WaitsUntilAllAreRunning) {
  const ProcessList list =
      list_with(R"(script "s" { start group "g" wait "running"; start cmd "c"; })");
  ScriptRun run(list, "s", 10.0);
  EXPECT_TRUE(advance(run, 0));
  standings_ = {{"a", ProcessState::kRunning}, {"b", ProcessState::kChanging}};
  EXPECT_FALSE(advance(run, 1));
  EXPECT_FALSE(run.is_finished());
  standings_["b"] = ProcessState::kRunning;
  EXPECT_THAT(advance(run, 2)->ids, ElementsAre("c"));
}

TEST_F(ScriptRunTest, FailsIfAWaitTimesOut) {
  const ProcessList list = list_with(
      R"(script "s" { wait cmd "c" status "running" timeout_s 2; start cmd "c"; }
         script "t" { wait group "g" status "running"; })");
  ScriptRun run(list, "s", 10.0);
  EXPECT_FALSE(advance(run, 0));
  EXPECT_FALSE(advance(run, 1999 * kMs));
  EXPECT_FALSE(run.is_finished());
  EXPECT_FALSE(advance(run, 2000 * kMs));
  EXPECT_TRUE(run.is_finished());
  EXPECT_EQ(run.failure(), "script \"s\" timed out waiting for \"c\" to be running");

  ScriptRun slow(list, "t", 10.0);
  EXPECT_FALSE(advance(slow, 0));
  EXPECT_FALSE(advance(slow, 9999 * kMs));
  EXPECT_FALSE(slow.is_finished());
  EXPECT_FALSE(advance(slow, 10'000 * kMs));
  EXPECT_TRUE(slow.is_finished());
}

TEST_F(ScriptRunTest, ResumesAfterNestedScripts) {
  const ProcessList list = list_with(R"(script "s" { run_script "t"; start cmd "a"; }
                                        script "t" { wait ms 5; stop cmd "b" wait "stopped"; })");
  standings_ = {{"b", ProcessState::kChanging}};
  ScriptRun run(list, "s", 10.0);
  EXPECT_FALSE(advance(run, 0));
  EXPECT_THAT(advance(run, 5 * kMs)->ids, ElementsAre("b"));
  EXPECT_FALSE(advance(run, 6 * kMs));
  standings_ = {{"b", ProcessState::kStopped}};
  EXPECT_THAT(advance(run, 7 * kMs)->ids, ElementsAre("a"));
  EXPECT_FALSE(advance(run, 8 * kMs));
  EXPECT_TRUE(run.is_finished());
}

TEST_F(ScriptRunTest, RejectsAMissingScript) {
  const ProcessList list = list_with("");
  EXPECT_THROW(ScriptRun(list, "s", 10.0), std::invalid_argument);
}

}  // namespace
}  // namespace adit
