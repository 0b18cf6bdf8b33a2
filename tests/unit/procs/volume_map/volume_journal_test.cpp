// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/volume_map/volume_journal.hpp"

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "common/journal/journal.hpp"
#include "procs/volume_map/volume_record.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/procs/volume_map/swept_tunnel.hpp"

namespace adit {
namespace {

constexpr std::int64_t kUtime = 1'600'000'000'000'000;
constexpr std::size_t kTimeRecordBytes =
    journal_format::kHeaderBytes + std::string_view("VOLUME_SCAN_TIME").size() + sizeof(kUtime);

Cloud sweep(std::int32_t id, double x) {
  Cloud cloud = test::sweep_of_tunnel({x, 0.0, 0.0}, 20);
  cloud.id = id;
  cloud.utime = kUtime + id;
  return cloud;
}

void place(VolumeMap& map, int session, std::int64_t utime, const Pose2& T_map_odom) {
  map.set_graph({kUtime, utime, {{}, {5.0, 0.0, 0.0}}, {}});
  map.set_correction({kUtime + utime, utime, session, session, T_map_odom, {}});
}

void expect_same(const VolumeMap& a, const VolumeMap& b) {
  ASSERT_EQ(a.volumes().size(), b.volumes().size());
  for (std::size_t i = 0; i < a.volumes().size(); ++i) {
    const SubVolume& volume = a.volumes()[i].volume;
    const PlacedVolume& other = b.volumes()[i];
    EXPECT_EQ(volume.octree(), other.volume.octree());
    EXPECT_EQ(volume.scans(), other.volume.scans());
    EXPECT_EQ(volume.utime(), other.volume.utime());
    EXPECT_EQ(volume.occupied(), other.volume.occupied());
    EXPECT_EQ(a.volumes()[i].T_map_volume, other.T_map_volume);
    ASSERT_EQ(volume.points().size(), other.volume.points().size());
    for (std::size_t k = 0; k < volume.points().size(); ++k) {
      ASSERT_EQ(volume.points()[k].p_volume, other.volume.points()[k].p_volume);
      ASSERT_EQ(volume.points()[k].scan, other.volume.points()[k].scan);
    }
  }
}

class VolumeJournalOnDisk : public testing::Test {
 protected:
  [[nodiscard]] VolumeMap restored() const {
    VolumeMap map{VolumeMapParams{}};
    map.restore(VolumeJournal(path_).take_restored());
    return map;
  }

  test::ScratchFolder scratch_;
  std::filesystem::path path_ = scratch_ / "volume.journal";
};

TEST_F(VolumeJournalOnDisk, RestoresTheVolume) {
  VolumeMap map{VolumeMapParams{}};
  {
    VolumeJournal journal(path_);
    map.add(sweep(1, 0.0));  // before the first graph
    journal.store(map);
    place(map, 0, 1, {});
    journal.store(map);
    map.add(sweep(2, 1.0));
    journal.store(map);
    map.add(sweep(3, 12.0));
    journal.store(map);
  }
  VolumeMap again = restored();
  place(again, 0, 1, {});
  expect_same(again, map);
  EXPECT_EQ(again.excluded(), 0);
  again.add(sweep(4, 12.5));  // restored volumes are closed
  EXPECT_EQ(again.volumes().size(), 3U);
  std::size_t points = 0;
  for (const PlacedVolume& placed : map.volumes()) points += placed.volume.points().size();
  EXPECT_LT(std::filesystem::file_size(path_), 16 * points);
}

/// As the stage does, which stores points in the journal only.
TEST_F(VolumeJournalOnDisk, HasAllPointsThoughTheMapReleasesThem) {
  VolumeMap all{VolumeMapParams{}};
  VolumeMap released_map{VolumeMapParams{}};
  place(all, 0, 1, {});
  place(released_map, 0, 1, {});
  const auto add = [&](VolumeJournal& journal, const Cloud& cloud) {
    all.add(cloud);
    released_map.add(cloud);
    journal.store(released_map);
    released_map.release_points();
    for (const PlacedVolume& placed : released_map.volumes()) {
      EXPECT_TRUE(placed.volume.points().empty());
    }
  };
  {
    VolumeJournal journal(path_);
    add(journal, sweep(1, 0.0));
    add(journal, sweep(2, 1.0));  // into the same sub-volume
    add(journal, sweep(3, 12.0));
  }
  VolumeMap again = restored();
  place(again, 0, 1, {});
  expect_same(again, all);

  VolumeJournal journal(path_);
  released_map = VolumeMap{VolumeMapParams{}};
  released_map.restore(journal.take_restored());
  released_map.release_points();
  place(released_map, 0, 2, {});
  add(journal, sweep(4, -8.0));
  EXPECT_GT(released_map.volumes()[0].volume.released_points(), 1000U);
}

TEST_F(VolumeJournalOnDisk, RestoresAReplacedVolume) {
  VolumeMapParams params;
  params.replace_radius_m = 1.0;
  VolumeMap map{params};
  place(map, 0, 1, {});
  {
    VolumeJournal journal(path_);
    for (const double x : {0.0, 12.0, 0.5}) {
      map.add(sweep(static_cast<std::int32_t>(x), x));
      journal.store(map);
    }
    map.add(sweep(4, 1.5));  // into the same sub-volume
    journal.store(map);
  }
  ASSERT_EQ(map.volumes().size(), 2U);
  VolumeMap again = restored();
  place(again, 0, 1, {});
  expect_same(again, map);
}

TEST_F(VolumeJournalOnDisk, RestoresTheViewpoints) {
  VolumeMapParams params;
  params.replace_radius_m = 1.0;
  const auto behind = [](std::int32_t id, double x) {
    Cloud cloud = sweep(id, x);
    for (CloudLine& line : cloud.lines) line.origin.x() = -1.0F;
    return cloud;
  };
  {
    VolumeMap map{params};
    place(map, 0, 1, {});
    map.add(sweep(1, 0.0));
    map.add(behind(2, 0.0));
    VolumeJournal(path_).store(map);
  }
  VolumeMap again{params};
  again.restore(VolumeJournal(path_).take_restored());
  place(again, 0, 1, {});
  again.add(sweep(3, 12.0));
  again.add(behind(4, 0.0));
  ASSERT_EQ(again.volumes().size(), 3U);
  EXPECT_EQ(again.volumes()[0].volume.points().front().scan, 1);
  EXPECT_EQ(again.volumes()[1].volume.points().front().scan, 4);
}

TEST_F(VolumeJournalOnDisk, LosesOneScanToATornRecord) {
  VolumeMap map{VolumeMapParams{}};
  place(map, 0, 1, {});
  VolumeMap first{VolumeMapParams{}};
  place(first, 0, 1, {});
  {
    VolumeJournal journal(path_);
    for (VolumeMap* of : {&map, &first}) of->add(sweep(1, 0.0));
    journal.store(map);
    map.add(sweep(2, 1.0));
    journal.store(map);
  }
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) - kTimeRecordBytes - 7);
  std::filesystem::remove(journal_copy(path_));
  VolumeMap again = restored();
  place(again, 0, 1, {});
  expect_same(again, first);
}

TEST_F(VolumeJournalOnDisk, RestoresTheScanTimes) {
  VolumeMap map{VolumeMapParams{}};
  {
    VolumeJournal journal(path_);
    map.add(sweep(1, 0.0));
    journal.store(map);
    map.add(sweep(2, 12.0));
    journal.store(map);
  }
  EXPECT_EQ(restored().scan_utimes(), (std::vector{kUtime + 1, kUtime + 2}));
  EXPECT_EQ(restored().scan_utimes(), map.scan_utimes());
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) - kTimeRecordBytes - 7);
  std::filesystem::remove(journal_copy(path_));
  EXPECT_EQ(restored().scan_utimes(),
            (std::vector{kUtime + 1}));  // the other one can be requested again
}

/// A power loss before an announced scan is stored; a new odom frame begins.
TEST_F(VolumeJournalOnDisk, AnchorsAnEarlierScanByItsOdomFrameAfterARestart) {
  const Pose2 T_map_odom{3.0, 0.5, 0.2};
  {
    VolumeMap map{VolumeMapParams{}};
    VolumeJournal journal(path_);
    map.set_odom_epoch(kUtime - 50);
    place(map, 0, 1, T_map_odom);
    journal.store(map);
  }
  VolumeMap again = restored();
  again.set_odom_epoch(kUtime + 100);
  place(again, 1, 2, {});  // the pose of the current odom frame does not matter
  EXPECT_EQ(again.localized_from_utime(), kUtime - 50);
  EXPECT_TRUE(again.add(sweep(7, 1.0)));
  const Pose2 expected = T_map_odom * Pose2{1.0, 0.0, 0.0};
  const Pose2& T_map_volume = again.volumes().back().T_map_volume.plan;
  EXPECT_LT((T_map_volume.vector() - expected.vector()).norm(), 1e-9);
  EXPECT_FALSE(again.add(sweep(-60, 0.0)));  // from before that odom frame
  EXPECT_EQ(again.excluded(), 1);
}

TEST_F(VolumeJournalOnDisk, RestoresAnOdomFrameThatEndedWithoutALocalMap) {
  {
    VolumeMap map{VolumeMapParams{}};
    map.set_odom_epoch(kUtime - 50);
    place(map, 0, 1, {});
    VolumeJournal(path_).store(map);
  }
  {
    VolumeMap map = restored();
    map.set_odom_epoch(kUtime + 100);
    VolumeJournal(path_).store(map);
  }
  VolumeMap again = restored();
  again.set_odom_epoch(kUtime + 200);
  EXPECT_FALSE(again.add(sweep(150, 0.0)));
  EXPECT_TRUE(again.add(sweep(50, 0.0)));
}

TEST_F(VolumeJournalOnDisk, ContinuesInTheSameOdomFrameAfterARestartOfTheProcess) {
  const Pose2 T_map_odom{3.0, 0.5, 0.2};
  {
    VolumeMap map{VolumeMapParams{}};
    map.set_odom_epoch(kUtime - 50);
    place(map, 0, 1, T_map_odom);
    VolumeJournal(path_).store(map);
  }
  VolumeMap again = restored();
  again.set_odom_epoch(kUtime - 50);
  EXPECT_TRUE(again.add(sweep(7, 1.0)));  // before any correction
  ASSERT_TRUE(again.volumes().back().anchor);
  EXPECT_EQ(again.volumes().back().anchor->local_map, 0);
}

TEST_F(VolumeJournalOnDisk, IsRejectedByAMapWithAnotherCellSize) {
  VolumeMap map{VolumeMapParams{}};
  map.add(sweep(1, 0.0));
  VolumeJournal(path_).store(map);
  VolumeMapParams params;
  params.cell_m = 0.2;
  VolumeMap other{params};
  EXPECT_THROW(other.restore(VolumeJournal(path_).take_restored()), std::runtime_error);
}

TEST(VolumeRecord, IsEmptyForMalformedBytes) {
  EXPECT_FALSE(volume_record_from({}));
  VolumeRecord record;
  record.volume.contents.cell_m = 0.1;
  const auto bytes = to_bytes(record);
  EXPECT_TRUE(volume_record_from(bytes));
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    EXPECT_FALSE(volume_record_from(std::span(bytes).first(n)));
  }
}

/// A power loss before the first local map; a new odom frame begins.
TEST_F(VolumeJournalOnDisk, ExcludesVolumesOfAnUnknownOdomFrame) {
  VolumeMap map{VolumeMapParams{}};
  map.add(sweep(1, 0.0));
  VolumeJournal(path_).store(map);
  VolumeMap again = restored();
  place(again, 1, 1, {});
  EXPECT_EQ(again.excluded(), 1);
  EXPECT_FALSE(again.volumes()[0].anchor);
}

TEST(VolumeMapOverSessions, AnchorsAScanToItsOdomFrame) {
  VolumeMap map{VolumeMapParams{}};
  place(map, 0, 1, {1.0, 0.0, 0.0});
  place(map, 1, 100, {7.0, 0.0, 0.0});
  EXPECT_TRUE(map.add(sweep(50, 2.0)));   // of the previous session
  EXPECT_TRUE(map.add(sweep(150, 2.0)));  // of the new session
  ASSERT_EQ(map.volumes().size(), 2U);
  EXPECT_NEAR(map.volumes()[0].T_map_volume.plan.x, 3.0, 1e-9);
  EXPECT_EQ(map.volumes()[0].anchor->local_map, 0);
  EXPECT_NEAR(map.volumes()[1].T_map_volume.plan.x, 9.0, 1e-9);
  EXPECT_EQ(map.volumes()[1].anchor->local_map, 1);
}

}  // namespace
}  // namespace adit
