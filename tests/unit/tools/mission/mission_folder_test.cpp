// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/mission/mission_folder.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/bus/node/stages.hpp"
#include "common/config/config_file.hpp"
#include "common/files/file_utils.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mission.hpp"
#include "procs/mission/mission_journal.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

constexpr std::int64_t kStart = 1'600'000'000'000'000;

void write_log(const std::filesystem::path& path, double x_m) {
  LogWriter log(path);
  const auto bytes = encode(to_message(StampedPose{kStart, {x_m, 0.5, 0.25}, {}}));
  log.write({kStart, channels::kTruth, bytes});
  log.close();
}

TEST(MissionFolder, ProtectsAnExistingMission) {
  const test::ScratchFolder scratch;
  const MissionFolder folder(scratch.path() / "new");
  folder.require_new();
  EXPECT_THROW(folder.require_unfinished(), std::runtime_error);
  write_log(folder.next_log(), 1.0);
  EXPECT_THROW(folder.require_new(), std::runtime_error);
}

TEST(MissionFolder, FindsTheLastPoseInTheNewestLogWithTruth) {
  const test::ScratchFolder scratch;
  const MissionFolder folder(scratch.path());
  EXPECT_THROW(static_cast<void>(folder.last_pose()), std::runtime_error);
  write_log(folder.next_log(), 1.0);
  write_log(folder.next_log(), 2.0);
  write_text_file("", folder.next_log());  // power loss immediately after the start
  const SimulatedPose last = folder.last_pose();
  EXPECT_EQ(last.utime, kStart);
  EXPECT_EQ(last.T_world_body.translation(), Eigen::Vector2d(2.0, 0.5));
  EXPECT_EQ(folder.logs().size(), 3);
}

TEST(MissionFolder, HasCompressedLogsBesidePlainOnes) {
  const test::ScratchFolder scratch;
  const MissionFolder folder(scratch.path());
  write_log(folder.next_log(), 1.0);
  const auto second = folder.next_log(LogForm::kCompressed);
  EXPECT_EQ(second.filename(), "run_2.lcmlog.zst");
  write_log(second, 2.0);
  EXPECT_EQ(folder.logs().size(), 2);
  EXPECT_EQ(folder.last_pose().T_world_body.translation(), Eigen::Vector2d(2.0, 0.5));
  EXPECT_EQ(folder.next_log().filename(), "run_3.lcmlog");
}

TEST(MissionFolder, DoesNotResumeAMissionThatHasEnded) {
  const test::ScratchFolder scratch;
  const MissionFolder folder(scratch.path());
  write_text_file("", folder.world());
  write_text_file("", folder.config());
  MissionPhase phase;
  phase.utime = kStart;
  phase.phase = Phase::kScan;
  MissionJournal(folder.journal()).append(phase);
  folder.require_unfinished();
  phase.phase = Phase::kEnded;
  MissionJournal(folder.journal()).append(phase);
  EXPECT_THROW(folder.require_unfinished(), std::runtime_error);
}

TEST(MissionFiles, HaveEachSectionOnceAndCanBeLoaded) {
  const ConfigFile file = ConfigFile::parse(mission_config(""), "mission.yaml");
  file.require_known_sections(config_sections());
  for (const char* section : {"mapping", "mission", "guard", "lasers", "vehicle", "sim"}) {
    EXPECT_NE(file.section(section), nullptr) << section;
  }
  EXPECT_EQ(without_repeated_sections({"a:\n  x: 1\nb:\n  y: 2\n", "b:\n  y: 3\nc:\n  z: 4\n"}),
            "a:\n  x: 1\nb:\n  y: 2\nc:\n  z: 4\n");
}

}  // namespace
}  // namespace adit
