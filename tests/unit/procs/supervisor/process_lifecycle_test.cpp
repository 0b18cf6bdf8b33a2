// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/management/process_lifecycle.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

using Act = ProcessLifecycle::Act;
using State = LifecycleState;

constexpr std::int64_t kMs = 1000;
constexpr std::int64_t kSecond = 1'000'000;

LifecycleRules respawning() {
  LifecycleRules rules;
  rules.auto_respawn = true;
  rules.stop_time_allowed_s = 3.0;
  rules.backoff = {0.5, 4.0, 10.0};
  return rules;
}

LifecycleRules requiring_liveness() {
  LifecycleRules rules = respawning();
  rules.requires_liveness = true;
  rules.start_timeout_s = 2.0;
  return rules;
}

/// A lifecycle started at time 0.
ProcessLifecycle started_lifecycle(const LifecycleRules& rules) {
  ProcessLifecycle lifecycle(rules);
  lifecycle.request_start();
  EXPECT_EQ(lifecycle.advance(0, true, false), Act::kStart);
  lifecycle.started(0);
  return lifecycle;
}

TEST(ProcessLifecycle, DoesNothingUntilStartIsRequested) {
  ProcessLifecycle lifecycle(respawning());
  EXPECT_EQ(lifecycle.advance(0, true, true), Act::kNothing);
  EXPECT_EQ(lifecycle.state(), State::kStopped);
  EXPECT_FALSE(lifecycle.runs());
}

TEST(ProcessLifecycle, WaitsForItsDependencies) {
  ProcessLifecycle lifecycle(respawning());
  lifecycle.request_start();
  EXPECT_EQ(lifecycle.advance(0, false, false), Act::kNothing);
  EXPECT_EQ(lifecycle.state(), State::kWaiting);
  EXPECT_EQ(lifecycle.advance(kSecond, true, false), Act::kStart);
  lifecycle.started(kSecond);
  EXPECT_EQ(lifecycle.state(), State::kRunning);
  EXPECT_EQ(lifecycle.advance(2 * kSecond, false, false),
            Act::kNothing);  // no effect after the start
  EXPECT_EQ(lifecycle.state(), State::kRunning);
}

TEST(ProcessLifecycle, RunsOnceItIsAlive) {
  ProcessLifecycle lifecycle = started_lifecycle(requiring_liveness());
  EXPECT_EQ(lifecycle.advance(kSecond, true, false), Act::kNothing);
  EXPECT_EQ(lifecycle.state(), State::kStarting);
  EXPECT_EQ(lifecycle.advance(kSecond + 1, true, true), Act::kNothing);
  EXPECT_EQ(lifecycle.state(), State::kRunning);
}

TEST(ProcessLifecycle, IsRestartedIfItIsNotAliveInTime) {
  ProcessLifecycle lifecycle = started_lifecycle(requiring_liveness());
  EXPECT_EQ(lifecycle.advance(2 * kSecond - 1, true, false), Act::kNothing);
  EXPECT_EQ(lifecycle.advance(2 * kSecond, true, false), Act::kRequestStop);
  EXPECT_EQ(lifecycle.error(), "did not reach its publish rate within 2.0 s");
  lifecycle.ended(3 * kSecond, "killed by SIGINT", false);
  EXPECT_EQ(lifecycle.state(), State::kBackoff);
  EXPECT_EQ(lifecycle.error(), "did not reach its publish rate within 2.0 s");
  EXPECT_EQ(lifecycle.advance(3 * kSecond + 499 * kMs, true, false), Act::kNothing);
  EXPECT_EQ(lifecycle.advance(3 * kSecond + 500 * kMs, true, false), Act::kStart);
}

TEST(ProcessLifecycle, IsStoppedIfItNoLongerPublishes) {
  ProcessLifecycle lifecycle = started_lifecycle(requiring_liveness());
  lifecycle.advance(kSecond, true, true);
  EXPECT_EQ(lifecycle.advance(2 * kSecond, true, false), Act::kRequestStop);
  EXPECT_EQ(lifecycle.error(), "publish rate too low");
  EXPECT_EQ(lifecycle.state(), State::kStopping);
}

TEST(ProcessLifecycle, IsRestartedIfItIgnoresItsInput) {
  LifecycleRules rules = respawning();
  rules.ignored_input = "ignored its input";
  rules.restart_limit = 1;
  ProcessLifecycle lifecycle = started_lifecycle(rules);
  EXPECT_EQ(lifecycle.advance(kSecond, true, false, Answers::kAwaited), Act::kNothing);
  EXPECT_EQ(lifecycle.advance(12 * kSecond, true, false, Answers::kMissing), Act::kRequestStop);
  EXPECT_EQ(lifecycle.error(), "ignored its input");
  lifecycle.ended(12 * kSecond, "killed by SIGINT", false);
  EXPECT_EQ(lifecycle.advance(13 * kSecond, true, false), Act::kStart);
  lifecycle.started(13 * kSecond);
  EXPECT_EQ(lifecycle.total_restarts(), 1);
  // A run without an answer is not stable, so the restart limit is reached.
  EXPECT_EQ(lifecycle.advance(24 * kSecond, true, false, Answers::kAwaited), Act::kNothing);
  EXPECT_EQ(lifecycle.restarts(), 1);
  EXPECT_EQ(lifecycle.advance(25 * kSecond, true, false, Answers::kMissing), Act::kRequestStop);
  lifecycle.ended(25 * kSecond, "killed by SIGINT", false);
  EXPECT_EQ(lifecycle.state(), State::kFailed);
}

TEST(ProcessLifecycle, FailsWithoutAutoRespawn) {
  LifecycleRules rules = requiring_liveness();
  rules.auto_respawn = false;
  ProcessLifecycle lifecycle = started_lifecycle(rules);
  EXPECT_EQ(lifecycle.advance(2 * kSecond, true, false), Act::kRequestStop);
  lifecycle.ended(3 * kSecond, "killed by SIGINT", false);
  EXPECT_EQ(lifecycle.state(), State::kFailed);
  EXPECT_EQ(lifecycle.advance(100 * kSecond, true, false), Act::kNothing);
}

TEST(ProcessLifecycle, IsStoppedOnceAndKilledAfterTheTimeAllowed) {
  ProcessLifecycle lifecycle = started_lifecycle(respawning());
  lifecycle.request_stop(kSecond);
  EXPECT_EQ(lifecycle.advance(kSecond, true, false), Act::kRequestStop);
  EXPECT_EQ(lifecycle.advance(kSecond + 1, true, false), Act::kNothing);
  EXPECT_EQ(lifecycle.advance(4 * kSecond - 1, true, false), Act::kNothing);
  EXPECT_EQ(lifecycle.advance(4 * kSecond, true, false), Act::kKill);
  EXPECT_EQ(lifecycle.advance(4 * kSecond + 1, true, false), Act::kNothing);
  EXPECT_EQ(lifecycle.advance(5 * kSecond, true, false), Act::kKill);
  lifecycle.ended(5 * kSecond, "killed by SIGKILL", false);
  EXPECT_EQ(lifecycle.state(), State::kStopped);
  EXPECT_EQ(lifecycle.error(), "");  // the stop was requested
}

TEST(ProcessLifecycle, IsKilledImmediatelyIfNoTimeIsAllowed) {
  LifecycleRules rules = respawning();
  rules.stop_time_allowed_s = 0.0;
  ProcessLifecycle lifecycle = started_lifecycle(rules);
  lifecycle.request_stop(kSecond);
  EXPECT_EQ(lifecycle.advance(kSecond, true, false), Act::kKill);
}

TEST(ProcessLifecycle, DoublesTheBackoffUpToALimit) {
  ProcessLifecycle lifecycle = started_lifecycle(respawning());
  std::int64_t now = 0;
  for (const std::int64_t pause : {500 * kMs, 1000 * kMs, 2000 * kMs, 4000 * kMs, 4000 * kMs}) {
    lifecycle.ended(now, "ended with exit code 1", false);
    EXPECT_EQ(lifecycle.state(), State::kBackoff);
    EXPECT_EQ(lifecycle.advance(now + pause - 1, true, false), Act::kNothing);
    now += pause;
    EXPECT_EQ(lifecycle.advance(now, true, false), Act::kStart);
    lifecycle.started(now);
  }
  EXPECT_EQ(lifecycle.restarts(), 5);
}

TEST(ProcessLifecycle, ResetsTheBackoffAfterAStableRun) {
  ProcessLifecycle lifecycle = started_lifecycle(respawning());
  lifecycle.ended(0, "ended with exit code 1", false);
  lifecycle.advance(kSecond, true, false);
  lifecycle.started(kSecond);
  lifecycle.advance(11 * kSecond - 1, true, false);
  EXPECT_EQ(lifecycle.restarts(), 1);
  EXPECT_EQ(lifecycle.error(), "ended with exit code 1");
  lifecycle.advance(11 * kSecond, true, false);
  EXPECT_EQ(lifecycle.restarts(), 0);
  EXPECT_EQ(lifecycle.total_restarts(), 1);
  EXPECT_EQ(lifecycle.error(), "");
}

TEST(ProcessLifecycle, FailsAtItsRestartLimit) {
  LifecycleRules rules = respawning();
  rules.restart_limit = 2;
  ProcessLifecycle lifecycle = started_lifecycle(rules);
  for (int i = 1; i <= 2; ++i) {
    lifecycle.ended(i * 10 * kSecond, "ended with exit code 1", false);
    EXPECT_EQ(lifecycle.advance((i * 10 + 5) * kSecond, true, false), Act::kStart);
    lifecycle.started((i * 10 + 5) * kSecond);
  }
  lifecycle.ended(30 * kSecond, "ended with exit code 1", false);
  EXPECT_EQ(lifecycle.state(), State::kFailed);
  lifecycle.request_start();  // explicit start
  EXPECT_EQ(lifecycle.restarts(), 0);
  EXPECT_EQ(lifecycle.advance(40 * kSecond, true, false), Act::kStart);
}

TEST(ProcessLifecycle, CountsFailedStarts) {
  LifecycleRules rules = respawning();
  rules.restart_limit = 0;
  ProcessLifecycle lifecycle(rules);
  lifecycle.request_start();
  EXPECT_EQ(lifecycle.advance(0, true, false), Act::kStart);
  lifecycle.start_failed(0, "no such file");
  EXPECT_EQ(lifecycle.state(), State::kFailed);
  EXPECT_EQ(lifecycle.error(), "no such file");
}

TEST(ProcessLifecycle, StopsAfterASuccessfulEndWithoutAutoRespawn) {
  LifecycleRules rules;
  ProcessLifecycle succeeded = started_lifecycle(rules);
  succeeded.ended(kSecond, "ended with exit code 0", true);
  EXPECT_EQ(succeeded.state(), State::kStopped);
  ProcessLifecycle badly = started_lifecycle(rules);
  badly.ended(kSecond, "killed by SIGSEGV", false);
  EXPECT_EQ(badly.state(), State::kFailed);
  EXPECT_EQ(badly.error(), "killed by SIGSEGV");
}

TEST(ProcessLifecycle, RestartsImmediatelyOnRequest) {
  ProcessLifecycle lifecycle = started_lifecycle(respawning());
  lifecycle.request_restart(kSecond);
  EXPECT_EQ(lifecycle.state(), State::kStopping);
  EXPECT_EQ(lifecycle.advance(kSecond, true, false), Act::kRequestStop);
  lifecycle.ended(kSecond + 5, "killed by SIGINT", false);
  EXPECT_EQ(lifecycle.advance(kSecond + 5, true, false), Act::kStart);
  lifecycle.started(kSecond + 5);
  EXPECT_EQ(lifecycle.restarts(), 0);
  EXPECT_EQ(lifecycle.error(), "");
}

TEST(ProcessLifecycle, RestartsIfStartIsRequestedWhileStopping) {
  ProcessLifecycle lifecycle = started_lifecycle(respawning());
  lifecycle.request_stop(kSecond);
  lifecycle.request_start();
  lifecycle.ended(2 * kSecond, "killed by SIGINT", false);
  EXPECT_EQ(lifecycle.advance(2 * kSecond, true, false), Act::kStart);
}

TEST(ProcessLifecycle, StaysStoppedIfThatWasTheLastRequest) {
  ProcessLifecycle lifecycle = started_lifecycle(respawning());
  lifecycle.request_restart(kSecond);
  lifecycle.request_stop(kSecond);
  lifecycle.ended(2 * kSecond, "killed by SIGINT", false);
  EXPECT_EQ(lifecycle.state(), State::kStopped);

  ProcessLifecycle pausing = started_lifecycle(respawning());
  pausing.ended(0, "ended with exit code 1", false);
  pausing.request_stop(1);
  EXPECT_EQ(pausing.advance(60 * kSecond, true, false), Act::kNothing);
  EXPECT_EQ(pausing.state(), State::kStopped);
}

TEST(ProcessLifecycle, NamesItsStates) {
  EXPECT_EQ(name_of(State::kRunning), "running");
  EXPECT_EQ(name_of(State::kBackoff), "pausing");
  EXPECT_EQ(name_of(State::kFailed), "failed");
}

}  // namespace
}  // namespace adit
