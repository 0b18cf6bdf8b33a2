// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "procs/volume_map/placed_volume.hpp"
#include "procs/volume_map/volume_map.hpp"

namespace adit {
namespace {

constexpr double kPi = std::numbers::pi;

/// A scan of three points of rock ahead.
Cloud scan_of_rock(const Pose2& T_odom_level, std::int32_t id, float laser_m = 1.0F) {
  CloudLine line{0, {laser_m, 0.0F, 0.5F}, {}, {}};
  for (const float y : {-1.0F, 0.0F, 1.0F}) line.points.emplace_back(2.0F * laser_m, y, 0.5F);
  return {id, id, T_odom_level, true, {line}};
}

class ScanReplacement : public testing::Test {
 protected:
  explicit ScanReplacement(double replace_radius_m = 2.0) : map_(params(replace_radius_m)) {
    map_.set_graph({0, 1, {Pose2{}}, {}});
    map_.set_correction({0, 1, 0, 0, {}, {}});
  }

  static VolumeMapParams params(double replace_radius_m) {
    VolumeMapParams params;
    params.replace_radius_m = replace_radius_m;
    return params;
  }

  void scan_from(const Pose2& T_map_level, float laser_m = 1.0F) {
    map_.add(scan_of_rock(T_map_level, ++scans_, laser_m));
  }
  void scan_from(double x) { scan_from(Pose2{x, 0.0, 0.0}); }

  /// The ids of the stored scans by sub-volume; 0 if it is empty.
  [[nodiscard]] std::vector<std::int32_t> stored_scans() const {
    std::vector<std::int32_t> stored_scans;
    for (const PlacedVolume& placed : map_.volumes()) {
      stored_scans.push_back(placed.volume.is_empty() ? 0 : placed.volume.points().back().scan);
    }
    return stored_scans;
  }
  [[nodiscard]] int count() const {
    int n = 0;
    for (const PlacedVolume& placed : map_.volumes()) n += placed.volume.is_empty() ? 0 : 1;
    return n;
  }

  VolumeMap map_;
  std::int32_t scans_ = 0;
};

TEST_F(ScanReplacement, KeepsTheNewestScanOfEachViewpointAndHeading) {
  scan_from(0.0);
  scan_from(12.0);
  scan_from({0.0, 0.0, kPi});
  scan_from(12.0);
  scan_from(0.5);
  EXPECT_EQ(stored_scans(), (std::vector{5, 4, 3}));
  EXPECT_EQ(map_.volumes()[0].volume.scans(), 3);  // two scans, and one for the replacement
  EXPECT_TRUE(map_.volumes()[0].volume.is_open());
}

TEST_F(ScanReplacement, KeepsTheScanOfTheOtherLaserFromTheSamePlace) {
  for (int round = 0; round < 2; ++round) {
    scan_from(Pose2{}, 1.0F);
    scan_from(Pose2{}, -1.0F);
    scan_from(12.0);
  }
  EXPECT_EQ(stored_scans(), (std::vector{4, 5, 6}));
}

TEST_F(ScanReplacement, IgnoresWhereASpinningLidarCameFrom) {
  scan_from(0.0);
  scan_from(12.0);
  Cloud scan = scan_of_rock(Pose2{}, ++scans_, 1.0F);
  for (const float behind_m : {2.0F, 3.0F, 4.0F}) {
    scan.lines.push_back(scan.lines.front());
    scan.lines.back().origin.x() -= behind_m;
  }
  map_.add(scan);
  EXPECT_EQ(stored_scans(), (std::vector{3, 2}));
}

TEST_F(ScanReplacement, DiscardsAllOlderScansNearTheNewest) {
  scan_from(-1.5);
  scan_from(12.0);
  scan_from(1.5);
  scan_from(12.0);
  scan_from(0.0);
  EXPECT_EQ(stored_scans(), (std::vector{5, 4, 0}));
  EXPECT_EQ(map_.volumes()[2].volume.scans(), 2);  // so that subscribers are notified
  scan_from(20.0);
  EXPECT_EQ(stored_scans(), (std::vector{5, 4, 6}));
}

TEST_F(ScanReplacement, DoesNotMoveTheViewpointWithTheRobot) {
  for (int drive = 0; drive < 3; ++drive) {
    for (int i = 0; i < 20; ++i) scan_from(1.5 * i + 0.4 * drive);
    scan_from({40.0, 0.0, kPi / 2.0});
  }
  EXPECT_EQ(count(), 11);  // one in 3 m of 30 m, and the one at the end
}

TEST_F(ScanReplacement, CombinesScansOfOneVisit) {
  scan_from(0.0);
  scan_from(1.0);
  scan_from(0.5);
  ASSERT_EQ(count(), 1);
  EXPECT_EQ(map_.volumes()[0].volume.scans(), 3);
}

/// Rounds through a tunnel of 120 m and back, with a scan about every 8.5 m. After a few rounds the
/// number of scans does not grow.
class ScanReplacementOnPatrol : public ScanReplacement {
 protected:
  ScanReplacementOnPatrol() : ScanReplacement(4.0) {}

  void round() {
    for (const double heading : {0.0, kPi}) {
      for (double distance_m = 8.5 * uniform_(random_); distance_m < 120.0;
           distance_m += 7.0 + 3.0 * uniform_(random_)) {
        const double x = heading == 0.0 ? distance_m : 120.0 - distance_m;
        scan_from({x, uniform_(random_) - 0.5, heading + 0.8 * (uniform_(random_) - 0.5)});
      }
    }
  }
  double mean_count_over(int rounds) {
    int sum = 0;
    for (int i = 0; i < rounds; ++i) {
      round();
      sum += count();
    }
    return static_cast<double>(sum) / rounds;
  }

  std::mt19937 random_{7};
  std::uniform_real_distribution<double> uniform_{0.0, 1.0};
};

TEST_F(ScanReplacementOnPatrol, DoesNotGrowAfterTheFirstRounds) {
  mean_count_over(10);
  const double early = mean_count_over(20);
  mean_count_over(200);
  const double late = mean_count_over(20);
  EXPECT_NEAR(late, early, 0.05 * early);  // 5 %, the tolerance for the memory of the process
  EXPECT_LT(map_.volumes().size(), 60U);   // 4 m apart, for two headings
}

}  // namespace
}  // namespace adit
