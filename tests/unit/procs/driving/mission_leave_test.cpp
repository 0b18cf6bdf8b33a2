// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/mission_leave.hpp"

#include <gtest/gtest.h>

#include "procs/driving/driving.hpp"
#include "tests/support/path_sketch.hpp"

namespace adit {
namespace {

constexpr std::int64_t kStart = 1'600'000'000'000'000;
constexpr std::int64_t kPeriodUs = 50'000;

MissionPhase in(Phase phase, std::int32_t goal_id = 5) {
  MissionPhase said;
  said.phase = phase;
  said.goal_id = goal_id;
  return said;
}

TEST(MissionLeave, IsNotNeededWhereThereIsNoMission) {
  EXPECT_FALSE(MissionLeave().refusal(kStart, 5));
}

TEST(MissionLeave, IsForThePathOfThePhaseExecute) {
  MissionLeave leave;
  leave.hear(in(Phase::kExecute), kStart);
  EXPECT_FALSE(leave.refusal(kStart, 5));
  EXPECT_EQ(leave.refusal(kStart, 4), "the mission means another path");
  for (const Phase phase : {Phase::kWaiting, Phase::kExplore, Phase::kScan, Phase::kPlan,
                            Phase::kPaused, Phase::kEnded}) {
    leave.hear(in(phase), kStart);
    EXPECT_EQ(leave.refusal(kStart, 5), "the mission is not executing a path");
  }
}

TEST(MissionLeave, ExpiresWhereTheMissionIsSilent) {
  MissionLeave leave;
  leave.hear(in(Phase::kExecute), kStart);
  EXPECT_FALSE(leave.refusal(kStart + MissionLeave::kStaleUs, 5));
  EXPECT_EQ(leave.refusal(kStart + MissionLeave::kStaleUs + 1, 5), "the mission is silent");
}

TEST(DrivingWithAMission, StandsWhileThePhaseIsNotExecuteAndGoesOnAfter) {
  Driving driving{DrivingParams{}};
  PlannedPath path = PathSketch({}).go(8.0).path();
  path.id = 5;
  std::int64_t utime = kStart;
  DriveOutput output;
  const auto run = [&](const MissionPhase& phase, double seconds) {
    for (int i = 0; i < 20 * seconds; ++i) {
      utime += kPeriodUs;
      driving.add_phase(phase, utime);
      driving.add_pose(utime, {});
      output = driving.drive(utime);
    }
  };
  run(in(Phase::kPlan), 0.5);
  driving.follow(path);
  run(in(Phase::kPlan), 1.0);
  EXPECT_EQ(output.command.speed_m_s, 0.0);
  EXPECT_EQ(output.state.kind, DrivingState::Kind::kWaiting);
  EXPECT_EQ(output.state.reason, "the mission is not executing a path");
  run(in(Phase::kExecute), 1.0);
  EXPECT_GT(output.command.speed_m_s, 0.0);
  run(in(Phase::kPaused), 0.1);
  EXPECT_EQ(output.command.speed_m_s, 0.0);
  run(in(Phase::kExecute), 1.0);
  EXPECT_GT(output.command.speed_m_s, 0.0);
}

}  // namespace
}  // namespace adit
