// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/map_journal.hpp"

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

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

TEST_F(MapJournalOnDisk, RestoresTheMatchesOf3DScans) {
  const CloudMatch match{{1, 0, 0.1, 2.0}, {2, 1, 0.0, 0.0}, {5.0, 0.2, 0.1}};
  {
    MapJournal journal(path_);
    journal.append({local_map(0, 3), {}});
    journal.append({local_map(1, 3), {}, {match}});
  }
  EXPECT_EQ(read_map_journal(path_).cloud_matches, std::vector<CloudMatch>{match});
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

/// Damages the record of this number in both copies, from 0.
void damage_record(const std::filesystem::path& path, std::size_t number) {
  for (const auto& file : {path, journal_copy(path)}) {
    std::ifstream in(file, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    const JournalScan scan =
        scan_journal({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    const JournalScan::Found& record = scan.records.at(number);
    bytes[record.offset + record.size - 1] ^= 1;
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
  }
}

/// Along the x axis of odom, 5 m each.
LocalMap map_at(int id) {
  LocalMap map = local_map(id, 3);
  map.T_odom_local = {5.0 * id, 0.0, 0.0};
  map.T_previous_local = {5.0, 0.0, 0.0};
  map.information = Eigen::Matrix3d::Identity();
  return map;
}

TEST_F(MapJournalOnDisk, KeepsTheIdsOfTheLocalMapsAfterALostOne) {
  {
    MapJournal journal(path_);
    for (int id = 0; id < 4; ++id) journal.append({map_at(id), {}});
  }
  damage_record(path_, 1);
  for (int opened = 0; opened < 2; ++opened) {  // the repaired file still has the gap
    const StoredMap stored = read_map_journal(path_);
    ASSERT_EQ(stored.maps.size(), 4U);
    EXPECT_TRUE(stored.maps[1].scans.empty());
    EXPECT_EQ(stored.losses.local_maps, std::vector{1});
    EXPECT_EQ(stored.maps[3], map_at(3));
    EXPECT_EQ(stored.maps[2].scans, map_at(2).scans);
    // The empty one is at the end of the first, by odom.
    const Pose2 T_first_after = stored.maps[1].T_previous_local * stored.maps[2].T_previous_local;
    EXPECT_NEAR(T_first_after.x, 10.0, 1e-9);
    EXPECT_LT(stored.maps[2].information(0, 0), 1.0) << "the gap is uncertain by a metre or more";
    const MapJournal journal(path_);
    EXPECT_TRUE(journal.is_damaged());
    EXPECT_NE(journal.report().find("local map 1 lost"), std::string::npos) << journal.report();
  }
}

TEST_F(MapJournalOnDisk, TakesThePartsOfALostLocalMap) {
  {
    MapJournal journal(path_);
    journal.append({map_at(0), {}});
    LocalMap part = map_at(1);
    part.scans.pop_back();
    part.end_utime = part.scans.back().scan.utime;
    journal.append_unfinished(part);
    journal.append({map_at(1), {}});
    journal.append({map_at(2), {}});
  }
  damage_record(path_, 2);
  const StoredMap stored = read_map_journal(path_);
  ASSERT_EQ(stored.maps.size(), 3U);
  EXPECT_EQ(stored.maps[1].scans.size(), 2U);
  EXPECT_EQ(stored.maps[2], map_at(2)) << "linked as before";
  EXPECT_EQ(stored.losses.shortened, std::vector{1});
  EXPECT_FALSE(stored.losses.has_gap());
}

/// The first part or one in the middle: where the robot was last is known by those after it.
TEST_F(MapJournalOnDisk, UsesThePartsOfAnUnfinishedLocalMapAfterALostOne) {
  for (const std::size_t lost : {1U, 2U}) {
    const std::filesystem::path path = scratch_ / ("lost_" + std::to_string(lost) + ".journal");
    const LocalMap whole = local_map(1, 6);
    {
      MapJournal journal(path);
      journal.append({local_map(0, 3), {}});
      for (const int scans : {2, 4, 6}) journal.append_unfinished(local_map(1, scans));
    }
    damage_record(path, lost);
    const StoredMap stored = read_map_journal(path);
    ASSERT_TRUE(stored.unfinished);
    EXPECT_EQ(stored.unfinished->scans.size(), 4U);
    EXPECT_EQ(stored.unfinished->scans.back(), whole.scans.back());
    EXPECT_EQ(stored.unfinished->end_utime, whole.end_utime);
    EXPECT_EQ(stored.losses.shortened, std::vector{1});
    MapJournal journal(path);
    EXPECT_NE(journal.report().find("local map 1 without some scans"), std::string::npos);
    journal.append({whole, {}});
    EXPECT_TRUE(read_map_journal(path).losses.shortened.empty()) << "the whole map is stored";
  }
}

TEST_F(MapJournalOnDisk, DoesNotKnowWhatFollowedTheLastLocalMap) {
  {
    MapJournal journal(path_);
    for (int id = 0; id < 3; ++id) journal.append({map_at(id), {}});
  }
  damage_record(path_, 2);
  const StoredMap stored = read_map_journal(path_);
  EXPECT_EQ(stored.maps.size(), 2U);
  EXPECT_TRUE(stored.losses.end);
  MapJournal(path_).append({map_at(2), {}});
  EXPECT_TRUE(read_map_journal(path_).losses.end) << "known in later sessions too";
  EXPECT_TRUE(MapJournal(path_).is_damaged());
}

TEST_F(MapJournalOnDisk, HasAnEmptyLocalMapForHomeIfNothingIsLeft) {
  MapJournal(path_).append({map_at(0), {}});
  damage_record(path_, 0);
  const StoredMap stored = read_map_journal(path_);
  ASSERT_EQ(stored.maps.size(), 1U);
  EXPECT_TRUE(stored.maps[0].scans.empty());
  EXPECT_TRUE(stored.losses.end);
}

}  // namespace
}  // namespace adit
