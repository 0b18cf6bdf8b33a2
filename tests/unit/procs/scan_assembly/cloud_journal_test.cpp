// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_assembly/cloud_journal.hpp"

#include <filesystem>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/journal/journal.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

constexpr std::int64_t kUtime = 1'600'000'000'000'000;
constexpr std::int64_t kLater = kUtime + 100 * CloudBuffer::kResendDelayUs;

/// Clouds sent at their own time, a microsecond apart.
CloudBuffer buffer_of(int clouds) {
  CloudBuffer buffer;
  for (int i = 0; i < clouds; ++i) {
    Cloud cloud;
    cloud.utime = kUtime + i;
    buffer.add(cloud, cloud.utime);
  }
  return buffer;
}

CloudRequest request_having(const std::vector<std::int64_t>& received_utime,
                            std::int64_t after_utime = 0) {
  return {kLater, after_utime, received_utime};
}

TEST(CloudBuffer, FindsTheNewestMissingCloud) {
  const CloudBuffer clouds = buffer_of(4);
  const Cloud* const missing =
      clouds.find_missing(request_having({kUtime + 3, kUtime + 1}), kLater);
  ASSERT_NE(missing, nullptr);
  EXPECT_EQ(missing->utime, kUtime + 2);
  EXPECT_EQ(clouds.find_missing(request_having({}), kLater)->utime, kUtime + 3);
}

TEST(CloudBuffer, FindsNothingIfTheRequesterHasAll) {
  const CloudBuffer clouds = buffer_of(2);
  EXPECT_EQ(clouds.find_missing(request_having({kUtime + 1, kUtime}), kLater), nullptr);
  EXPECT_EQ(clouds.find_missing(request_having({}, kUtime + 1), kLater), nullptr);
  EXPECT_NE(clouds.find_missing(request_having({}, kUtime), kLater), nullptr);
  EXPECT_EQ(CloudBuffer{}.find_missing(request_having({}), kLater), nullptr);
}

TEST(CloudBuffer, FindsNothingThatMayBeInTransit) {
  const CloudBuffer clouds = buffer_of(1);
  const std::int64_t utime = kUtime + CloudBuffer::kResendDelayUs;
  EXPECT_EQ(clouds.find_missing(request_having({}), utime - 1), nullptr);
  EXPECT_NE(clouds.find_missing(request_having({}), utime), nullptr);
}

TEST(CloudBuffer, HoldsTheNewestClouds) {
  const CloudBuffer clouds = buffer_of(static_cast<int>(CloudBuffer::kMax) + 1);
  std::vector<std::int64_t> received_utime;
  for (std::size_t i = 1; i <= CloudBuffer::kMax; ++i) {
    received_utime.push_back(kUtime + static_cast<std::int64_t>(i));
  }
  EXPECT_EQ(clouds.find_missing(request_having(received_utime), kLater), nullptr);
}

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::int64_t kFirstUtime = 1'600'000'000'000'000;

/// A cloud of several fragments.
Cloud cloud_of(int id) {
  Cloud cloud;
  cloud.utime = kFirstUtime + id;
  cloud.id = id;
  cloud.T_odom_level = {1.0, 2.0, 0.25};
  cloud.z_odom_m = -3.5;
  for (int i = 0; i < 200; ++i) {
    CloudLine line;
    line.utime = kFirstUtime - 200 + i;
    line.origin = {0.5F, 0.0F, 1.0F};
    line.points.assign(180, {static_cast<float>(i), static_cast<float>(id), 0.125F});
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

TEST_F(CloudJournalTest, RestoresAStoredCloud) {
  const Cloud cloud = cloud_of(7);
  CloudJournal(path_).store(cloud);
  const std::vector<Cloud> restored = CloudJournal(path_).take_restored();
  ASSERT_EQ(restored.size(), 1U);
  const Cloud& loaded = restored.front();
  EXPECT_EQ(loaded.utime, cloud.utime);
  EXPECT_EQ(loaded.id, cloud.id);
  EXPECT_EQ(loaded.T_odom_level, cloud.T_odom_level);
  EXPECT_EQ(loaded.z_odom_m, cloud.z_odom_m);
  EXPECT_TRUE(loaded.complete);
  ASSERT_EQ(loaded.lines.size(), cloud.lines.size());
  for (std::size_t i = 0; i < cloud.lines.size(); ++i) {
    EXPECT_EQ(loaded.lines[i].utime, cloud.lines[i].utime);
    ASSERT_EQ(loaded.lines[i].points.size(), cloud.lines[i].points.size());
    EXPECT_TRUE(loaded.lines[i].points.front().isApprox(cloud.lines[i].points.front(), 1e-3F));
    EXPECT_EQ(loaded.lines[i].misses.size(), cloud.lines[i].misses.size());
  }
}

TEST_F(CloudJournalTest, IsClearedWhenAllCloudsAreAcknowledged) {
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

TEST_F(CloudJournalTest, IsClearedByAcknowledgementsAfterARestart) {
  CloudJournal(path_).store(cloud_of(1));
  CloudJournal(path_).acknowledge(std::vector{kFirstUtime + 1});
  EXPECT_THAT(restored(), IsEmpty());
}

TEST_F(CloudJournalTest, LeavesOutAnIncompleteCloud) {
  {
    CloudJournal journal(path_);
    journal.store(cloud_of(1));
    journal.store(cloud_of(2));
  }
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) - 5);
  std::filesystem::remove(journal_copy(path_));
  CloudJournal(path_).store(cloud_of(3));
  EXPECT_THAT(restored(), ElementsAre(1, 3));
}

TEST_F(CloudJournalTest, IsBoundedWithoutAcknowledgements) {
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
