// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Mapping of a drive over a step that all wheels climb at once, with 3D scans.
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "procs/mapping/mapping.hpp"
#include "tests/support/worlds/rock_sweep.hpp"
#include "tests/support/worlds/wall_world.hpp"
#include "tests/unit/procs/mapping/mapped_world.hpp"

namespace adit {
namespace {

constexpr double kStepUpM = 0.04;
constexpr double kStepAtM = 1.0;
constexpr double kScansApartM = 4.0;
constexpr double kDrivenM = 16.5;
constexpr std::int64_t kBegin = 1'600'000'000'000'000;
constexpr std::int64_t kScanUs = 1'000'000;

/// Scans, and a 3D scan every four metres; the attitude shows no step.
struct DriveOverAStep {
  Mapping mapping{MappingParams{}};
  StoredMap stored;

  explicit DriveOverAStep(bool with_passed_lines = false) {
    test::LevelLaser laser(test::sample_mine(1), 1);
    std::int64_t utime = kBegin;
    double next_cloud_m = 0.0;
    for (int i = 0; 0.2 * i <= kDrivenM; ++i, utime += kScanUs) {
      const double x = 0.2 * i;
      add(laser, x, utime);
      if (x + 1e-9 < next_cloud_m) continue;
      next_cloud_m += kScansApartM;
      const double z = x < kStepAtM ? 0.0 : kStepUpM;
      Cloud cloud = test::sweep(test::rough_tunnel, test::pose(x, 0.0, z, 0.0, 0.0, 0.0),
                                static_cast<unsigned>(i));
      cloud.utime = utime;
      cloud.T_odom_level = {x, 0.0, 0.0};
      if (with_passed_lines) add_passed_lines(cloud);
      mapping.add(cloud);
      utime += kScanUs;
      add(laser, x, utime);
    }
    keep(mapping.finish());
  }

 private:
  void add(test::LevelLaser& laser, double x, std::int64_t utime) {
    ScanMatch match;
    match.utime = utime;
    match.odom_epoch_utime = kBegin;
    match.channel = test::kFront;
    match.status = utime == kBegin ? ScanMatch::Status::kFirstScan : ScanMatch::Status::kMatched;
    match.reference_utime = utime == kBegin ? 0 : utime - kScanUs;
    match.T_odom_body = {x, 0.0, 0.0};
    match.attitude = Attitude{};
    keep(mapping.add(test::kFront, laser.measure(match.T_odom_body, utime), match));
  }

  /// Of a spinning lidar 2 m before, 0.1 m too high.
  static void add_passed_lines(Cloud& cloud) {
    const std::vector<CloudLine> lines = cloud.lines;
    for (CloudLine line : lines) {
      line.origin.x() -= 2.0F;
      for (Eigen::Vector3f& p : line.points) p.z() += 0.1F;
      cloud.lines.push_back(std::move(line));
    }
  }

  void keep(const std::optional<MapUpdate>& update) {
    if (!update) return;
    stored.maps.push_back(update->map);
    stored.associations.insert(stored.associations.end(), update->associations.begin(),
                               update->associations.end());
    stored.cloud_matches.insert(stored.cloud_matches.end(), update->cloud_matches.begin(),
                                update->cloud_matches.end());
  }
};

TEST(MappedRises, MatchOnlyLinesThatOdometryHasNotPlaced) {
  const DriveOverAStep drive;
  const DriveOverAStep with_passed_lines(true);
  ASSERT_FALSE(drive.stored.cloud_matches.empty());
  EXPECT_EQ(with_passed_lines.stored.cloud_matches, drive.stored.cloud_matches);
}

TEST(MappedRises, ShowTheStepThatThePitchDoesNot) {
  const DriveOverAStep drive;
  const MapGraph graph = drive.mapping.graph();
  ASSERT_GE(graph.z_m.size(), 4U);
  for (std::size_t i = 1; i < graph.z_m.size(); ++i) EXPECT_NEAR(graph.z_m[i], kStepUpM, 0.01);
}

TEST(MappedRises, BeginALocalMapAtEach3DScan) {
  const DriveOverAStep drive;
  for (std::size_t i = 1; i < drive.stored.maps.size(); ++i) {
    EXPECT_NEAR(drive.stored.maps[i].T_odom_local.x, kScansApartM * static_cast<double>(i), 1e-9);
  }
}

TEST(MappedRises, AreKeptOverARestart) {
  DriveOverAStep drive;
  ASSERT_FALSE(drive.stored.cloud_matches.empty());
  const MapGraph before = drive.mapping.graph();
  Mapping again{MappingParams{}};
  again.restore(std::move(drive.stored));
  const MapGraph after = again.graph();
  ASSERT_EQ(after.z_m.size(), before.z_m.size());
  for (std::size_t i = 0; i < after.z_m.size(); ++i) {
    EXPECT_NEAR(after.z_m[i], before.z_m[i], 1e-6);
    EXPECT_NEAR(after.z_variance[i], before.z_variance[i], 1e-8);
  }
}

}  // namespace
}  // namespace adit
