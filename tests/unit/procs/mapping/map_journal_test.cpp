// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/map_journal.hpp"

#include <gtest/gtest.h>

#include "common/journal/journal.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

constexpr std::int64_t kStart = 1'600'000'000'000'000;

LocalMap local_map(int id, int scans) {
  LocalMap map;
  map.id = id;
  map.utime = map.end_utime = kStart + id * 1'000'000;
  for (int i = 0; i < scans; ++i) {
    LocalScan scan;
    scan.channel = "LASER_FRONT";
    scan.scan.utime = map.end_utime = map.utime + i * 1000;
    scan.scan.angle_step_rad = 0.1;
    scan.scan.ranges_m = {1.0F, 2.0F, 3.0F};
    scan.T_local_body = {0.1 * i, 0.0, 0.0};
    map.scans.push_back(scan);
  }
  return map;
}

class MapJournalOnDisk : public testing::Test {
 protected:
  test::ScratchFolder scratch_;
  std::filesystem::path path_ = scratch_ / "map.journal";
};

TEST_F(MapJournalOnDisk, RestoresTheUnfinishedLocalMap) {
  {
    MapJournal journal(path_);
    journal.append({local_map(0, 3), {}});
    journal.append_unfinished(local_map(1, 2));
    journal.append_unfinished(local_map(1, 5));
  }
  const StoredMap stored = read_map_journal(path_);
  EXPECT_EQ(stored.maps.size(), 1U);
  ASSERT_TRUE(stored.unfinished);
  EXPECT_EQ(*stored.unfinished, local_map(1, 5));
}

TEST_F(MapJournalOnDisk, LosesOnePartToATruncatedRecord) {
  {
    MapJournal journal(path_);
    journal.append_unfinished(local_map(0, 2));
    journal.append_unfinished(local_map(0, 5));
  }
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) - 1);
  std::filesystem::remove(journal_copy(path_));
  const StoredMap stored = read_map_journal(path_);
  ASSERT_TRUE(stored.unfinished);
  EXPECT_EQ(*stored.unfinished, local_map(0, 2));
}

TEST_F(MapJournalOnDisk, DropsThePartsOfAFinishedLocalMap) {
  {
    MapJournal journal(path_);
    journal.append_unfinished(local_map(0, 2));
    journal.append({local_map(0, 6), {}});
  }
  const StoredMap stored = read_map_journal(path_);
  EXPECT_FALSE(stored.unfinished);
  ASSERT_EQ(stored.maps.size(), 1U);
  EXPECT_EQ(stored.maps[0], local_map(0, 6));
}

/// The next local map reuses the id of a discarded one.
TEST_F(MapJournalOnDisk, RestoresTheReplacementOfADiscardedLocalMap) {
  LocalMap next = local_map(1, 4);
  for (LocalScan& scan : next.scans) scan.scan.utime += 10'000;
  next.utime += 10'000;
  next.end_utime += 10'000;
  {
    MapJournal journal(path_);
    journal.append({local_map(0, 3), {}});
    journal.append_unfinished(local_map(1, 5));
    journal.append_unfinished(next);
  }
  const StoredMap stored = read_map_journal(path_);
  ASSERT_TRUE(stored.unfinished);
  EXPECT_EQ(*stored.unfinished, next);
}

}  // namespace
}  // namespace adit
