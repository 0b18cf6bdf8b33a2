// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// A mission resumes from its journal, wherever it was interrupted.
#include <filesystem>
#include <string>
#include <utility>

#include <gmock/gmock.h>

#include "procs/mission/mission_journal.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/procs/mission/scripted_stages.hpp"

namespace adit {
namespace {

using testing::HasSubstr;

class MissionRestart : public ScriptedStages {
 protected:
  /// The process ends after the last phase was stored, and another one starts.
  void restart() {
    store();
    mission_ = Mission(MissionParams{});
    MissionJournal journal(file());
    ASSERT_TRUE(journal.last());
    mission_.restore(*journal.last(), *journal.start_utime(), journal.take_stored_path());
    driving_ = {};
  }
  void store() {
    MissionJournal journal(file());
    for (const StoredPathPose& pose : stored_) journal.append(pose);
    stored_.clear();
    journal.append(phase());
  }
  [[nodiscard]] std::filesystem::path file() const { return scratch_ / "mission.journal"; }

  test::ScratchFolder scratch_;
};

TEST_F(MissionRestart, ResumesFromEachPhase) {
  for (const Phase phase : {Phase::kExplore, Phase::kScan, Phase::kPlan, Phase::kExecute}) {
    to(phase);
    if (phase == Phase::kExecute) drive(2.0);
    const MissionPhase before = this->phase();
    restart();
    EXPECT_EQ(now(), Phase::kWaiting);
    EXPECT_EQ(this->phase().scans, before.scans);
    EXPECT_EQ(this->phase().goal_id, before.goal_id);
    EXPECT_EQ(this->phase().distance_travelled_m, before.distance_travelled_m);
    EXPECT_THAT(this->phase().reason, HasSubstr(before.reason));
    const int request = request_.id;
    to_explore();
    EXPECT_GT(request_.id, request);  // not answered before
    EXPECT_GT(this->phase().sequence, before.sequence);
    EXPECT_FALSE(this->phase().returning_home);
  }
}

TEST_F(MissionRestart, StillReturnsHome) {
  to_execute();
  order(MissionOrder::Kind::kReturnHome);
  restart();
  to_explore();
  EXPECT_TRUE(phase().returning_home);
  EXPECT_EQ(phase().return_home_reason, "by order");
  EXPECT_TRUE(request_.returning_home);
}

TEST_F(MissionRestart, StaysPaused) {
  to_execute();
  order(MissionOrder::Kind::kPause);
  restart();
  wait(10.0);
  EXPECT_EQ(now(), Phase::kPaused);
  order(MissionOrder::Kind::kResume);
  to_explore();
}

TEST_F(MissionRestart, StaysEnded) {
  to_explore();
  answer(Kind::kDone);
  const MissionPhase before = phase();
  restart();
  wait(10.0);
  EXPECT_EQ(phase().phase, Phase::kEnded);
  EXPECT_EQ(phase().outcome, MissionOutcome::kHome);
  EXPECT_EQ(phase().sequence, before.sequence);
}

TEST_F(MissionRestart, ReturnsHomeIfTheComputerWasOff) {
  match(kStart);
  to_execute();
  restart();
  utime_ += 60'000'000;
  match(utime_);
  EXPECT_TRUE(phase().returning_home);
  EXPECT_EQ(phase().return_home_reason, "the computer was off");
  map(utime_);
  to_explore();
  EXPECT_TRUE(request_.returning_home);
}

TEST_F(MissionRestart, ResumesIfOnlyItsProcessWasOff) {
  match(kStart);
  to_execute();
  restart();
  match(kStart);
  to_explore();
  EXPECT_FALSE(request_.returning_home);
}

TEST_F(MissionRestart, RestoresTheTraversedPath) {
  match(kStart);
  to_execute();
  drive(5.0);
  restart();
  tick();  // a pose may arrive before its match
  match(kStart);
  EXPECT_NEAR(phase().distance_travelled_m, 5.0, 0.3);  // spacing of poses
  to_plan();
  path(PlanOutcome::kBlocked);
  EXPECT_THAT(phase().reason, HasSubstr("backing off"));
  ASSERT_FALSE(goal_.traversed_path_odom.empty());
  EXPECT_NEAR(goal_.traversed_path_odom.back().x, x_m_ - 3.0, 0.26);  // a step of driving
}

/// The computer was off: odom begins where the robot stands.
TEST_F(MissionRestart, RestoresTheTraversedPathInANewOdomFrameOnceTheMapCorrectionIsKnown) {
  match(kStart);
  map(kStart);
  to_execute();
  drive(5.0);
  restart();
  utime_ += 60'000'000;
  const double stands_m = std::exchange(x_m_, 0.0);
  tick();
  match(utime_);
  MapCorrection correction;
  correction.utime = utime_;
  correction.T_map_odom = {stands_m, 0.0, 0.0};
  mission_.add_correction(correction);
  reach_m_ = -10.0;
  to_scan(Kind::kHome);
  terrain();
  path(PlanOutcome::kBlocked);
  EXPECT_THAT(phase().reason, HasSubstr("along the traversed path"));
  ASSERT_GT(goal_.traversed_path_odom.size(), 10U);
  EXPECT_NEAR(goal_.traversed_path_odom.back().x, -stands_m, 0.26);  // the start of the mission
}

/// First of the mission, then of scan matching before a map correction arrives.
TEST_F(MissionRestart, RestoresTheTraversedPathAfterTwoRestarts) {
  match(kStart);
  map(kStart);
  to_execute();
  drive(5.0);
  restart();
  match(kStart);
  tick();
  match(utime_);
  map(utime_);
  to_plan();
  path(PlanOutcome::kBlocked);
  ASSERT_FALSE(goal_.traversed_path_odom.empty());
  EXPECT_NEAR(goal_.traversed_path_odom.back().x, x_m_ - 3.0, 0.26);  // a step of driving
}

TEST_F(MissionRestart, ContinuesTheTimeOfTheMission) {
  to_execute();
  drive(2.0);
  MissionJournal(file()).append(phase());
  utime_ += 20'000'000'000;  // of 28,800 s
  restart();
  tick();
  EXPECT_NEAR(phase().remaining_m, 8800.0 * 0.05, 1.0);
}

TEST_F(MissionRestart, DoesNotAccumulateReasonsOverRestarts) {
  to_execute();
  restart();
  const std::string reason = phase().reason;
  for (int i = 0; i < 5; ++i) restart();
  EXPECT_EQ(phase().reason, reason);
}

TEST_F(MissionRestart, RestoresTheRecordBeforeATornOne) {
  to_explore();
  MissionJournal(file()).append(phase());
  const auto complete = std::filesystem::file_size(file());
  const MissionPhase before = phase();
  answer(Kind::kGoTo);
  MissionJournal(file()).append(phase());
  const auto longer = std::filesystem::file_size(file());
  for (auto size = complete + 1; size < longer; size += 7) {
    const auto copy = scratch_ / ("torn_" + std::to_string(size));
    std::filesystem::copy_file(file(), copy);
    std::filesystem::resize_file(copy, size);
    const MissionJournal journal(copy);
    ASSERT_TRUE(journal.last());
    EXPECT_EQ(*journal.last(), before) << size;
  }
}

TEST_F(MissionRestart, StartsWithAnEmptyJournal) {
  const MissionJournal journal(file());
  EXPECT_FALSE(journal.last());
  EXPECT_FALSE(journal.start_utime());
}

/// After a power loss the first local map is newer than all before, unless the map lost some.
TEST(MissionLocalizationAfterPowerLoss, KnowsHomeOnlyInAMapThatHasNotLostItsEnd) {
  constexpr std::int64_t kBefore = 1'600'000'000'000'000;
  for (const int local_map : {0, 5, 7, 8}) {
    MissionLocalization localization;
    localization.restore(kBefore, 10.0, {}, {7, {}});
    localization.set_odom_epoch(kBefore + 10'000'000);
    MapCorrection correction;
    correction.utime = kBefore + 11'000'000;
    correction.local_map = local_map;
    localization.add_correction(correction);
    EXPECT_EQ(localization.known_map().home_unknown.has_value(), local_map <= 7) << local_map;
    EXPECT_EQ(localization.known_map().newest_local_map, std::max(7, local_map));
  }
}

/// The map lives on, and odom continues.
TEST(MissionLocalizationAfterRestart, KnowsHome) {
  constexpr std::int64_t kBefore = 1'600'000'000'000'000;
  MissionLocalization localization;
  localization.restore(kBefore, 10.0, {}, {7, {}});
  localization.set_odom_epoch(kBefore - 10'000'000);
  MapCorrection correction;
  correction.utime = kBefore;
  correction.local_map = 7;
  localization.add_correction(correction);
  EXPECT_FALSE(localization.known_map().home_unknown);
}

}  // namespace
}  // namespace adit
