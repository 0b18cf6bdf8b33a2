// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/keeping/process_life.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

using Act = ProcessLife::Act;
using State = LifeState;

constexpr std::int64_t kMs = 1000;
constexpr std::int64_t kSecond = 1'000'000;

LifeRules respawning() {
  LifeRules rules;
  rules.auto_respawn = true;
  rules.stop_time_allowed_s = 3.0;
  rules.pace = {0.5, 4.0, 10.0};
  return rules;
}

LifeRules showing_life() {
  LifeRules rules = respawning();
  rules.shows_life = true;
  rules.start_timeout_s = 2.0;
  return rules;
}

/// A life that has begun at time 0.
ProcessLife begun(const LifeRules& rules) {
  ProcessLife life(rules);
  life.want_running();
  EXPECT_EQ(life.advance(0, true, false), Act::kStart);
  life.started(0);
  return life;
}

TEST(ProcessLife, IsLeftAloneUntilSomebodyWantsIt) {
  ProcessLife life(respawning());
  EXPECT_EQ(life.advance(0, true, true), Act::kNothing);
  EXPECT_EQ(life.state(), State::kStopped);
  EXPECT_FALSE(life.runs());
}

TEST(ProcessLife, WaitsForWhatItDependsOn) {
  ProcessLife life(respawning());
  life.want_running();
  EXPECT_EQ(life.advance(0, false, false), Act::kNothing);
  EXPECT_EQ(life.state(), State::kWaiting);
  EXPECT_EQ(life.advance(kSecond, true, false), Act::kStart);
  life.started(kSecond);
  EXPECT_EQ(life.state(), State::kWorking);
  EXPECT_EQ(life.advance(2 * kSecond, false, false), Act::kNothing);  // too late to matter
  EXPECT_EQ(life.state(), State::kWorking);
}

TEST(ProcessLife, WorksOnceItShowsLife) {
  ProcessLife life = begun(showing_life());
  EXPECT_EQ(life.advance(kSecond, true, false), Act::kNothing);
  EXPECT_EQ(life.state(), State::kStarting);
  EXPECT_EQ(life.advance(kSecond + 1, true, true), Act::kNothing);
  EXPECT_EQ(life.state(), State::kWorking);
}

TEST(ProcessLife, IsStoppedAndStartedAgainIfItShowsNoLifeInTime) {
  ProcessLife life = begun(showing_life());
  EXPECT_EQ(life.advance(2 * kSecond - 1, true, false), Act::kNothing);
  EXPECT_EQ(life.advance(2 * kSecond, true, false), Act::kAskToStop);
  EXPECT_EQ(life.trouble(), "showed no life within 2.0 s");
  life.ended(3 * kSecond, "killed by SIGINT", false);
  EXPECT_EQ(life.state(), State::kPausing);
  EXPECT_EQ(life.trouble(), "showed no life within 2.0 s");
  EXPECT_EQ(life.advance(3 * kSecond + 499 * kMs, true, false), Act::kNothing);
  EXPECT_EQ(life.advance(3 * kSecond + 500 * kMs, true, false), Act::kStart);
}

TEST(ProcessLife, IsStoppedIfItNoLongerPublishes) {
  ProcessLife life = begun(showing_life());
  life.advance(kSecond, true, true);
  EXPECT_EQ(life.advance(2 * kSecond, true, false), Act::kAskToStop);
  EXPECT_EQ(life.trouble(), "no longer publishes as it should");
  EXPECT_EQ(life.state(), State::kStopping);
}

TEST(ProcessLife, IsGivenUpWhereItIsNotToBeStartedAgain) {
  LifeRules rules = showing_life();
  rules.auto_respawn = false;
  ProcessLife life = begun(rules);
  EXPECT_EQ(life.advance(2 * kSecond, true, false), Act::kAskToStop);
  life.ended(3 * kSecond, "killed by SIGINT", false);
  EXPECT_EQ(life.state(), State::kFailed);
  EXPECT_EQ(life.advance(100 * kSecond, true, false), Act::kNothing);
}

TEST(ProcessLife, IsAskedOnceToStopAndKilledWhenItsTimeIsOver) {
  ProcessLife life = begun(respawning());
  life.want_stopped(kSecond);
  EXPECT_EQ(life.advance(kSecond, true, false), Act::kAskToStop);
  EXPECT_EQ(life.advance(kSecond + 1, true, false), Act::kNothing);
  EXPECT_EQ(life.advance(4 * kSecond - 1, true, false), Act::kNothing);
  EXPECT_EQ(life.advance(4 * kSecond, true, false), Act::kKill);
  EXPECT_EQ(life.advance(4 * kSecond + 1, true, false), Act::kNothing);
  EXPECT_EQ(life.advance(5 * kSecond, true, false), Act::kKill);
  life.ended(5 * kSecond, "killed by SIGKILL", false);
  EXPECT_EQ(life.state(), State::kStopped);
  EXPECT_EQ(life.trouble(), "");  // it was asked for
}

TEST(ProcessLife, IsKilledAtOnceWhereNoTimeIsAllowed) {
  LifeRules rules = respawning();
  rules.stop_time_allowed_s = 0.0;
  ProcessLife life = begun(rules);
  life.want_stopped(kSecond);
  EXPECT_EQ(life.advance(kSecond, true, false), Act::kKill);
}

TEST(ProcessLife, PausesTwiceAsLongEachTimeUpToALimit) {
  ProcessLife life = begun(respawning());
  std::int64_t now = 0;
  for (const std::int64_t pause : {500 * kMs, 1000 * kMs, 2000 * kMs, 4000 * kMs, 4000 * kMs}) {
    life.ended(now, "ended with exit code 1", false);
    EXPECT_EQ(life.state(), State::kPausing);
    EXPECT_EQ(life.advance(now + pause - 1, true, false), Act::kNothing);
    now += pause;
    EXPECT_EQ(life.advance(now, true, false), Act::kStart);
    life.started(now);
  }
  EXPECT_EQ(life.restarts(), 5);
}

TEST(ProcessLife, ForgetsThePastAfterAGoodTime) {
  ProcessLife life = begun(respawning());
  life.ended(0, "ended with exit code 1", false);
  life.advance(kSecond, true, false);
  life.started(kSecond);
  life.advance(11 * kSecond - 1, true, false);
  EXPECT_EQ(life.restarts(), 1);
  EXPECT_EQ(life.trouble(), "ended with exit code 1");
  life.advance(11 * kSecond, true, false);
  EXPECT_EQ(life.restarts(), 0);
  EXPECT_EQ(life.trouble(), "");
}

TEST(ProcessLife, IsGivenUpAtItsLimit) {
  LifeRules rules = respawning();
  rules.restart_limit = 2;
  ProcessLife life = begun(rules);
  for (int i = 1; i <= 2; ++i) {
    life.ended(i * 10 * kSecond, "ended with exit code 1", false);
    EXPECT_EQ(life.advance((i * 10 + 5) * kSecond, true, false), Act::kStart);
    life.started((i * 10 + 5) * kSecond);
  }
  life.ended(30 * kSecond, "ended with exit code 1", false);
  EXPECT_EQ(life.state(), State::kFailed);
  life.want_running();  // somebody has seen to it
  EXPECT_EQ(life.restarts(), 0);
  EXPECT_EQ(life.advance(40 * kSecond, true, false), Act::kStart);
}

TEST(ProcessLife, CountsAProgramThatCannotBeStarted) {
  LifeRules rules = respawning();
  rules.restart_limit = 0;
  ProcessLife life(rules);
  life.want_running();
  EXPECT_EQ(life.advance(0, true, false), Act::kStart);
  life.could_not_start(0, "no such file");
  EXPECT_EQ(life.state(), State::kFailed);
  EXPECT_EQ(life.trouble(), "no such file");
}

TEST(ProcessLife, EndsAsItMayWhereItIsNotToBeStartedAgain) {
  LifeRules rules;
  ProcessLife well = begun(rules);
  well.ended(kSecond, "ended with exit code 0", true);
  EXPECT_EQ(well.state(), State::kStopped);
  ProcessLife badly = begun(rules);
  badly.ended(kSecond, "killed by SIGSEGV", false);
  EXPECT_EQ(badly.state(), State::kFailed);
  EXPECT_EQ(badly.trouble(), "killed by SIGSEGV");
}

TEST(ProcessLife, StartsAgainAtOnceWhenARestartIsWanted) {
  ProcessLife life = begun(respawning());
  life.want_restart(kSecond);
  EXPECT_EQ(life.state(), State::kStopping);
  EXPECT_EQ(life.advance(kSecond, true, false), Act::kAskToStop);
  life.ended(kSecond + 5, "killed by SIGINT", false);
  EXPECT_EQ(life.advance(kSecond + 5, true, false), Act::kStart);
  life.started(kSecond + 5);
  EXPECT_EQ(life.restarts(), 0);
  EXPECT_EQ(life.trouble(), "");
}

TEST(ProcessLife, StartsAgainWhereItIsWantedWhileItStops) {
  ProcessLife life = begun(respawning());
  life.want_stopped(kSecond);
  life.want_running();
  life.ended(2 * kSecond, "killed by SIGINT", false);
  EXPECT_EQ(life.advance(2 * kSecond, true, false), Act::kStart);
}

TEST(ProcessLife, StaysStoppedWhereThatWasTheLastWish) {
  ProcessLife life = begun(respawning());
  life.want_restart(kSecond);
  life.want_stopped(kSecond);
  life.ended(2 * kSecond, "killed by SIGINT", false);
  EXPECT_EQ(life.state(), State::kStopped);

  ProcessLife pausing = begun(respawning());
  pausing.ended(0, "ended with exit code 1", false);
  pausing.want_stopped(1);
  EXPECT_EQ(pausing.advance(60 * kSecond, true, false), Act::kNothing);
  EXPECT_EQ(pausing.state(), State::kStopped);
}

TEST(ProcessLife, HasAWordForEachState) {
  EXPECT_EQ(name_of(State::kWorking), "running");
  EXPECT_EQ(name_of(State::kPausing), "pausing");
  EXPECT_EQ(name_of(State::kFailed), "failed");
}

}  // namespace
}  // namespace adit
