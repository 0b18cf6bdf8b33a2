// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_assembly/cloud_journal.hpp"

#include <filesystem>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::int64_t kFirstUtime = 1'600'000'000'000'000;

/// In several pieces.
Cloud cloud_of(int number) {
  Cloud cloud;
  cloud.utime = kFirstUtime + number;
  cloud.id = number;
  cloud.T_odom_level = {1.0, 2.0, 0.25};
  for (int i = 0; i < 200; ++i) {
    CloudLine line;
    line.utime = kFirstUtime - 200 + i;
    line.origin = {0.5F, 0.0F, 1.0F};
    line.points.assign(180, {static_cast<float>(i), static_cast<float>(number), 0.125F});
    line.misses.assign(3, {1.0F, 0.0F, 0.0F});
    cloud.lines.push_back(line);
  }
  return cloud;
}

class CloudJournalOnDisk : public testing::Test {
 protected:
  [[nodiscard]] std::vector<std::int32_t> restored() const {
    std::vector<std::int32_t> ids;
    for (const Cloud& cloud : CloudJournal(path_).take_restored()) ids.push_back(cloud.id);
    return ids;
  }

  test::ScratchFolder scratch_;
  std::filesystem::path path_ = scratch_ / "scans.journal";
};

TEST_F(CloudJournalOnDisk, GivesBackWhatItKeeps) {
  const Cloud cloud = cloud_of(7);
  CloudJournal(path_).keep(cloud);
  const std::vector<Cloud> restored = CloudJournal(path_).take_restored();
  ASSERT_EQ(restored.size(), 1U);
  const Cloud& again = restored.front();
  EXPECT_EQ(again.utime, cloud.utime);
  EXPECT_EQ(again.id, cloud.id);
  EXPECT_EQ(again.T_odom_level, cloud.T_odom_level);
  EXPECT_TRUE(again.complete);
  ASSERT_EQ(again.lines.size(), cloud.lines.size());
  for (std::size_t i = 0; i < cloud.lines.size(); ++i) {
    EXPECT_EQ(again.lines[i].utime, cloud.lines[i].utime);
    ASSERT_EQ(again.lines[i].points.size(), cloud.lines[i].points.size());
    EXPECT_TRUE(again.lines[i].points.front().isApprox(cloud.lines[i].points.front(), 1e-3F));
    EXPECT_EQ(again.lines[i].misses.size(), cloud.lines[i].misses.size());
  }
}

TEST_F(CloudJournalOnDisk, ForgetsAllOnceNobodyLacksOne) {
  CloudJournal journal(path_);
  journal.keep(cloud_of(1));
  journal.keep(cloud_of(2));
  journal.let_go({});
  journal.let_go(std::vector{kFirstUtime + 2});
  EXPECT_GT(std::filesystem::file_size(path_), 0U);
  journal.let_go(std::vector{kFirstUtime + 1});
  EXPECT_EQ(std::filesystem::file_size(path_), 0U);
  journal.keep(cloud_of(3));
  EXPECT_GT(std::filesystem::file_size(path_), 0U);
}

TEST_F(CloudJournalOnDisk, ForgetsAfterARestartToo) {
  CloudJournal(path_).keep(cloud_of(1));
  CloudJournal(path_).let_go(std::vector{kFirstUtime + 1});
  EXPECT_THAT(restored(), IsEmpty());
}

TEST_F(CloudJournalOnDisk, LeavesOutOneThatIsTorn) {
  {
    CloudJournal journal(path_);
    journal.keep(cloud_of(1));
    journal.keep(cloud_of(2));
  }
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) - 5);
  CloudJournal(path_).keep(cloud_of(3));
  EXPECT_THAT(restored(), ElementsAre(1, 3));
}

TEST_F(CloudJournalOnDisk, IsBoundedWhereNobodySaysThatHeHasAny) {
  CloudJournal journal(path_);
  journal.keep(cloud_of(0));
  const std::uintmax_t one = std::filesystem::file_size(path_);
  for (std::size_t i = 1; i < 3 * CloudJournal::kMax; ++i) {
    journal.keep(cloud_of(static_cast<int>(i)));
    ASSERT_LE(std::filesystem::file_size(path_), CloudJournal::kMax * one);
  }
}

}  // namespace
}  // namespace adit
