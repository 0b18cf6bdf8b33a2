// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/mission/mission_watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/stages.hpp"
#include "common/bus/typed.hpp"
#include "common/messages/mission_phase.hpp"
#include "common/messages/pose.hpp"
#include "common/messages/sim_time.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::int64_t kStart = 1'600'000'000'000'000;
constexpr std::int64_t kSecond = 1'000'000;

class MissionWatchTest : public testing::Test {
 protected:
  void say_time(std::int64_t utime) {
    publish(bus_, channels::kSimTime, to_message(SimTime{utime}));
    bus_.advance_to(utime);
  }
  void all_but_planning_answer(std::int64_t utime) {
    for (const std::string& stage : stage_names()) {
      if (stage == "planning") continue;
      publish(bus_, channels::kSimTimeDone, to_message(SimTimeDone{utime, stage}));
    }
    bus_.advance_to(utime);
  }
  void say_phase(Phase phase, std::int32_t sequence) {
    MissionPhase now;
    now.utime = kStart;
    now.sequence = sequence;
    now.phase = phase;
    publish(bus_, channels::kPhase, to_message(now));
    bus_.advance_to(bus_.now_utime());
  }

  MemoryBus bus_;
  test::ScratchFolder scratch_;
  MissionWatch watch_{bus_, scratch_.path() / "phases.tsv", {3.0, 0.0}};
};

TEST_F(MissionWatchTest, MissesTheStageThatHoldsUpTheSimulatorOnce) {
  EXPECT_THAT(watch_.newly_silent(0), IsEmpty());
  say_time(kStart);
  all_but_planning_answer(kStart);
  EXPECT_THAT(watch_.newly_silent(5), IsEmpty());
  EXPECT_THAT(watch_.newly_silent(5 + MissionWatch::kStagePatienceUs - 1), IsEmpty());
  EXPECT_THAT(watch_.newly_silent(5 + MissionWatch::kStagePatienceUs), ElementsAre("planning"));
  EXPECT_THAT(watch_.newly_silent(5 + 3 * MissionWatch::kStagePatienceUs), IsEmpty());
}

TEST_F(MissionWatchTest, ForgivesAStageThatAnswersInTheEnd) {
  say_time(kStart);
  all_but_planning_answer(kStart);
  EXPECT_THAT(watch_.newly_silent(0), IsEmpty());
  publish(bus_, channels::kSimTimeDone, to_message(SimTimeDone{kStart, "planning"}));
  bus_.advance_to(kStart);
  EXPECT_THAT(watch_.newly_silent(2 * MissionWatch::kStagePatienceUs), IsEmpty());
}

TEST_F(MissionWatchTest, LetsTheLogGoOnForAWhileAfterTheEnd) {
  say_time(kStart);
  say_phase(Phase::kExplore, 1);
  EXPECT_FALSE(watch_.has_ended());
  say_phase(Phase::kEnded, 2);
  EXPECT_FALSE(watch_.has_ended());
  say_time(kStart + 3 * kSecond);
  EXPECT_TRUE(watch_.has_ended());
}

TEST_F(MissionWatchTest, MeasuresFromWhereTheRobotOnceBegan) {
  const auto be_at = [&](double x_m) {
    publish(bus_, channels::kTruth, to_message(StampedPose{kStart, {x_m, 4.0, 0.0}, {}}));
    bus_.advance_to(kStart);
  };
  be_at(6.0);
  EXPECT_DOUBLE_EQ(watch_.progress().from_start_m, 5.0);  // 3, 4, 5
  be_at(3.0);
  EXPECT_DOUBLE_EQ(watch_.progress().from_start_m, 4.0);
  EXPECT_DOUBLE_EQ(watch_.farthest_m(), 5.0);
}

}  // namespace
}  // namespace adit
