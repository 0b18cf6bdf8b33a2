// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// An interrupted mission whose journals are damaged before it is resumed.
#include <filesystem>

#include <gtest/gtest.h>

#include "tests/support/journals/damaged_stages.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/mission/mission_folder.hpp"
#include "tools/mission/mission_run.hpp"

namespace adit {
namespace {

using test::DamageOutcome;
using test::JournalDamage;

constexpr double kHomeM = 0.5;  // from the start; the mission accepts as much by the map

class DamagedJournals : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch_ = new test::ScratchFolder;
    MissionRunOptions options = mission();
    options.time_max_s = 70.0;
    run_mission(options);
  }
  static void TearDownTestSuite() { delete scratch_; }

  static MissionRunOptions mission() {
    MissionRunOptions options;
    options.world.name = "random_level";
    options.world.seed = 2;
    options.world.length_m = 30.0;
    options.folder = *scratch_ / "mission";
    return options;
  }

  /// Resumes a copy of the mission after damage to one of its journals.
  static MissionRunResult resume(const JournalDamage& damage, const std::string& journal,
                                 std::vector<std::string>& lines) {
    MissionRunOptions options = mission();
    options.folder = *scratch_ / "resumed";
    options.resume = true;
    options.time_max_s = 600.0;
    std::filesystem::remove_all(options.folder);
    test::copy_mission(*scratch_ / "mission", options.folder);
    std::mt19937 random(1);
    apply(damage, options.folder / journal, random);
    lines = journal_reports(MissionFolder(options.folder));
    return run_mission(options);
  }

  inline static test::ScratchFolder* scratch_ = nullptr;
};

TEST_F(DamagedJournals, LoseNothingUnreported) {
  test::DamagedStages stages(*scratch_ / "mission", *scratch_ / "cases");
  EXPECT_GE(stages.stages().size(), 4U);
  for (unsigned seed = 0; seed < 300; ++seed) {
    const test::DamagedCase result = stages.run(seed);
    ASSERT_NE(result.outcome, DamageOutcome::kUnreportedLoss)
        << seed << " " << result.stage << " " << text_of(result.damage);
    ASSERT_NE(result.outcome, DamageOutcome::kFalseHome)
        << seed << " " << result.stage << " " << text_of(result.damage);
    if (result.damage.files != JournalDamage::Files::kBoth) {
      ASSERT_TRUE(result.outcome == DamageOutcome::kRight ||
                  result.outcome == DamageOutcome::kUnchanged)
          << "one damage loses nothing: " << seed << " " << text_of(result.damage);
    }
  }
}

TEST_F(DamagedJournals, DoNotKeepTheRobotFromComingHomeIfOneCopyIsIntact) {
  std::vector<std::string> lines;
  const MissionRunResult result = resume({}, "mapping.journal", lines);
  EXPECT_EQ(result.last.phase.outcome, MissionOutcome::kHome) << result.last.phase.reason;
  EXPECT_LT(result.distance_from_start_m, kHomeM);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NE(lines.front().find("nothing lost"), std::string::npos) << lines.front();
}

/// The map is as it was metres before; only the mission knows that there was more.
TEST_F(DamagedJournals, DoNotLeadToAFalseHomeIfTheMapHasLostItsEnd) {
  std::vector<std::string> lines;
  const MissionRunResult result =
      resume({JournalDamage::Action::kTruncate, JournalDamage::Field::kHeader,
              JournalDamage::Position::kBegin, JournalDamage::Files::kBoth},
             "mapping.journal", lines);
  EXPECT_FALSE(result.last.phase.outcome == MissionOutcome::kHome &&
               result.distance_from_start_m > kHomeM)
      << result.last.phase.reason;
  EXPECT_FALSE(lines.empty());
}

/// Between smooth walls what the robot sees after the restart fits almost as well 0.7 m from where
/// it is; with the better fit alone the mission was sure of home 0.70 m from it.
TEST(ResumedMission, IsNotSureOfAWrongPlaceBetweenSmoothWalls) {
  const test::ScratchFolder scratch;
  MissionRunOptions options;
  options.world.name = "random";
  options.world.seed = 69;
  options.world.length_m = 40.0;
  options.folder = scratch / "mission";
  options.time_max_s = 132.28416818038673;
  run_mission(options);
  options.resume = true;
  options.time_max_s = 900.0;
  const MissionRunResult result = run_mission(options);
  EXPECT_TRUE(result.last.phase.outcome == MissionOutcome::kHome ||
              result.last.phase.outcome == MissionOutcome::kHomeUncertain)
      << result.last.phase.reason;
  EXPECT_LE(result.distance_from_start_m, result.last.phase.home_within_m.value_or(0.0));
}

}  // namespace
}  // namespace adit
