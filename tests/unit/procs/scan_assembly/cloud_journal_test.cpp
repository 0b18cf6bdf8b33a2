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

constexpr std::int64_t kUtime = 1'600'000'000'000'000;
constexpr std::int64_t kLater = kUtime + 100 * CloudBuffer::kResendDelayUs;

/// Scans that were sent when they were taken, a microsecond apart.
CloudBuffer buffer_of(int clouds) {
  CloudBuffer buffer_of;
  for (int i = 0; i < clouds; ++i) {
    Cloud cloud;
    cloud.utime = kUtime + i;
    buffer_of.add(cloud, cloud.utime);
  }
  return buffer_of;
}

CloudRequest request_having(const std::vector<std::int64_t>& received_utime,
                            std::int64_t after_utime = 0) {
  return {kLater, "volume_map", after_utime, received_utime};
}

TEST(CloudBuffer, GiveTheNewestThatTheOtherLacks) {
  const CloudBuffer clouds = buffer_of(4);
  const Cloud* const find_missing =
      clouds.find_missing(request_having({kUtime + 3, kUtime + 1}), kLater);
  ASSERT_NE(find_missing, nullptr);
  EXPECT_EQ(find_missing->utime, kUtime + 2);
  EXPECT_EQ(clouds.find_missing(request_having({}), kLater)->utime, kUtime + 3);
}

TEST(CloudBuffer, GiveNothingToWhoHasAllThatItWants) {
  const CloudBuffer clouds = buffer_of(2);
  EXPECT_EQ(clouds.find_missing(request_having({kUtime + 1, kUtime}), kLater), nullptr);
  EXPECT_EQ(clouds.find_missing(request_having({}, kUtime + 1), kLater), nullptr);
  EXPECT_NE(clouds.find_missing(request_having({}, kUtime), kLater), nullptr);
  EXPECT_EQ(CloudBuffer{}.find_missing(request_having({}), kLater), nullptr);
}

TEST(CloudBuffer, GiveNothingThatMayBeOnItsWay) {
  const CloudBuffer clouds = buffer_of(1);
  const std::int64_t utime = kUtime + CloudBuffer::kResendDelayUs;
  EXPECT_EQ(clouds.find_missing(request_having({}), utime - 1), nullptr);
  EXPECT_NE(clouds.find_missing(request_having({}), utime), nullptr);
}

TEST(CloudBuffer, AreTheNewest) {
  const CloudBuffer clouds = buffer_of(static_cast<int>(CloudBuffer::kMax) + 1);
  std::vector<std::int64_t> have;
  for (std::size_t i = 1; i <= CloudBuffer::kMax; ++i) {
    have.push_back(kUtime + static_cast<std::int64_t>(i));
  }
  EXPECT_EQ(clouds.find_missing(request_having(have), kLater), nullptr);
}

}  // namespace
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

class CloudJournalTest : public testing::Test {
 protected:
  [[nodiscard]] std::vector<std::int32_t> restored() const {
    std::vector<std::int32_t> ids;
    for (const Cloud& cloud : CloudJournal(path_).take_restored()) ids.push_back(cloud.id);
    return ids;
  }

  test::ScratchFolder scratch_;
  std::filesystem::path path_ = scratch_ / "scans.journal";
};

TEST_F(CloudJournalTest, GivesBackWhatItKeeps) {
  const Cloud cloud = cloud_of(7);
  CloudJournal(path_).store(cloud);
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

TEST_F(CloudJournalTest, ForgetsAllOnceNobodyLacksOne) {
  CloudJournal journal(path_);
  journal.store(cloud_of(1));
  journal.store(cloud_of(2));
  journal.acknowledge({});
  journal.acknowledge(std::vector{kFirstUtime + 2});
  EXPECT_GT(std::filesystem::file_size(path_), 0U);
  journal.acknowledge(std::vector{kFirstUtime + 1});
  EXPECT_EQ(std::filesystem::file_size(path_), 0U);
  journal.store(cloud_of(3));
  EXPECT_GT(std::filesystem::file_size(path_), 0U);
}

TEST_F(CloudJournalTest, ForgetsAfterARestartToo) {
  CloudJournal(path_).store(cloud_of(1));
  CloudJournal(path_).acknowledge(std::vector{kFirstUtime + 1});
  EXPECT_THAT(restored(), IsEmpty());
}

TEST_F(CloudJournalTest, LeavesOutOneThatIsTorn) {
  {
    CloudJournal journal(path_);
    journal.store(cloud_of(1));
    journal.store(cloud_of(2));
  }
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) - 5);
  CloudJournal(path_).store(cloud_of(3));
  EXPECT_THAT(restored(), ElementsAre(1, 3));
}

TEST_F(CloudJournalTest, IsBoundedWhereNobodySaysThatHeHasAny) {
  CloudJournal journal(path_);
  journal.store(cloud_of(0));
  const std::uintmax_t one = std::filesystem::file_size(path_);
  for (std::size_t i = 1; i < 3 * CloudJournal::kMax; ++i) {
    journal.store(cloud_of(static_cast<int>(i)));
    ASSERT_LE(std::filesystem::file_size(path_), CloudJournal::kMax * one);
  }
}

}  // namespace
}  // namespace adit
