// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/local_map_store.hpp"

#include <gtest/gtest.h>
#include <malloc.h>

#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

constexpr int kMaps = 100;
constexpr int kScans = 60;
constexpr int kBeams = 361;

/// As of a robot with an IMU and two lasers.
LocalMap local_map(int id) {
  LocalMap map;
  map.id = id;
  map.utime = 1'600'000'000'000'000 + id;
  map.T_odom_local = {1.0 / 3.0, 2.0 * id, 0.1};
  map.information = Eigen::Matrix3d::Identity() * id;
  for (int i = 0; i < kScans; ++i) {
    LocalScan scan;
    scan.channel = i % 2 == 0 ? "LASER_FRONT" : "LASER_REAR";
    scan.scan = {map.utime + i, std::vector<float>(kBeams, 0.1F * static_cast<float>(i)), -1.0,
                 0.1};
    scan.T_local_body = {0.1 * i, 1.0 / 7.0, 0.2};
    scan.z_m = 0.01 * i;
    if (i % 3 == 0) scan.attitude = Attitude{0.1, 0.2};
    if (i % 5 == 0) scan.unconfirmed_beams = {1, 7, 300};
    scan.attitude_from_ground = i % 4 == 0;
    map.scans.push_back(scan);
  }
  map.end_utime = map.scans.back().scan.utime;
  return map;
}

TEST(LocalMapStore, LoadsTheSameMapsFromMemoryAndFile) {
  const test::ScratchFolder folder;
  LocalMapStore in_memory;
  LocalMapStore in_file(folder.path());
  for (LocalMapStore* store : {&in_memory, &in_file}) {
    for (int i = 0; i < kMaps; ++i) store->push_back(local_map(i));
    store->pop_back();
    LocalMap without_scans = local_map(kMaps - 1);  // of a damaged journal
    without_scans.scans.clear();
    store->push_back(without_scans);
    ASSERT_EQ(store->size(), std::size_t{kMaps});
    EXPECT_EQ(store->load(kMaps - 1), without_scans);
    for (const int i : {0, 57, kMaps - 2}) {
      const auto at = static_cast<std::size_t>(i);
      EXPECT_EQ(store->load(at), local_map(i));
      EXPECT_EQ((*store)[at].scans.back().T_local_body, local_map(i).scans.back().T_local_body);
      EXPECT_EQ((*store)[at].end_utime, local_map(i).end_utime);
    }
  }
  EXPECT_EQ(in_file.load_all(), in_memory.load_all());
}

TEST(LocalMapStore, KeepsLessThanAKilobyteOfAMapInMemory) {
  const test::ScratchFolder folder;
  LocalMapStore store(folder.path());
  for (int i = 0; i < kMaps; ++i) store.push_back(local_map(i));  // and the buffer of the file
  const auto before = mallinfo2();
  for (int i = kMaps; i < 3 * kMaps; ++i) store.push_back(local_map(i));
  const auto after = mallinfo2();
  const auto bytes = static_cast<double>(after.uordblks + after.hblkhd) -
                     static_cast<double>(before.uordblks + before.hblkhd);
  EXPECT_LT(bytes / (2 * kMaps), 1000.0);
}

}  // namespace
}  // namespace adit
