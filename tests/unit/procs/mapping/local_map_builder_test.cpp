// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/local_map_builder.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace adit {
namespace {

using Status = ScanMatch::Status;

const std::string kFront = "LASER_FRONT";
const std::string kRear = "LASER_REAR";

/// Feeds the builder with scans matched at given poses.
class Feed {
 public:
  explicit Feed(int first_id = 0, int session = 0) : builder_({}, {}, first_id, session) {}

  void step(const Pose2& motion, Status status = Status::kMatched,
            const std::string& channel = kFront) {
    T_odom_body_ = T_odom_body_ * motion;
    scan(status, channel);
  }

  void scan(Status status, const std::string& channel = kFront) {
    ScanMatch match;
    match.status = first_ ? Status::kFirstScan : status;
    match.reference_utime = first_ ? 0 : utime_;
    match.utime = utime_ += 200'000;
    match.T_odom_body = T_odom_body_;
    match.channel = channel;
    match.covariance.diagonal() << 1e-4, 1e-4, 1e-5;
    match.unconfirmed_beams = {3, 4};
    first_ = false;
    LaserScan scan;
    scan.utime = match.utime;
    if (auto map = builder_.add(channel, scan, match)) maps.push_back(std::move(*map));
  }

  /// Scan matching was restarted.
  void restart() {
    first_ = true;
    T_odom_body_ = {};
    scan(Status::kFirstScan);
  }

  void finish() {
    if (auto map = builder_.finish()) maps.push_back(std::move(*map));
  }

  LocalMapBuilder& builder() { return builder_; }

  std::vector<LocalMap> maps;

 private:
  LocalMapBuilder builder_;
  Pose2 T_odom_body_;
  std::int64_t utime_ = 1'000'000'000;
  bool first_ = true;
};

TEST(LocalMapBuilder, StartsAMapEveryFiveMetres) {
  Feed feed;
  feed.scan(Status::kFirstScan);
  for (int i = 0; i < 80; ++i) feed.step({0.15, 0.0, 0.0});  // 12 m
  ASSERT_EQ(feed.maps.size(), 2U);
  for (int k = 0; k < 2; ++k) {
    EXPECT_EQ(feed.maps[k].id, k);
    EXPECT_EQ(feed.maps[k].session, 0);
    EXPECT_NEAR(feed.maps[k].scans.back().T_local_body.x, 5.1, 1e-9);  // the first beyond 5 m
    EXPECT_EQ(feed.maps[k].utime, feed.maps[k].scans.front().scan.utime);
    EXPECT_EQ(feed.maps[k].end_utime, feed.maps[k].scans.back().scan.utime);
  }
  EXPECT_EQ(feed.builder().current().id, 2);
}

TEST(LocalMapBuilder, TakesAllSurfacesForWallsWithout3DScans) {
  Feed feed;
  feed.scan(Status::kFirstScan);
  for (int i = 0; i < 40; ++i) feed.step({0.15, 0.0, 0.0});
  feed.finish();
  ASSERT_EQ(feed.maps.size(), 2U);
  for (const LocalMap& map : feed.maps) {
    for (const LocalScan& local : map.scans) EXPECT_TRUE(local.unconfirmed_beams.empty());
  }
}

/// What the body saw before the first 3D scan, at the start, may be ground as well.
TEST(LocalMapBuilder, KeepsTheUnconfirmedBeamsBeforeTheFirst3DScanOfALocalMap) {
  Feed feed;
  feed.scan(Status::kFirstScan);
  feed.builder().expect_ground();
  for (int i = 0; i < 40; ++i) feed.step({0.15, 0.0, 0.0});
  feed.finish();
  ASSERT_EQ(feed.maps.size(), 2U);
  for (const LocalMap& map : feed.maps) {
    for (const LocalScan& local : map.scans) {
      EXPECT_EQ(local.unconfirmed_beams, (std::vector<std::int32_t>{3, 4}));
    }
  }
}

/// Over metres of driving scan matching has found the surface in one place.
TEST(LocalMapBuilder, TakesSurfacesThatItDroveTowardsBeforeTheFirst3DScanForWalls) {
  Feed feed;
  feed.scan(Status::kFirstScan);
  for (int i = 0; i < 20; ++i) feed.step({0.15, 0.0, 0.0});
  const std::size_t before = feed.builder().current().scans.size();
  feed.builder().expect_ground();
  for (int i = 0; i < 10; ++i) feed.step({0.15, 0.0, 0.0});
  feed.finish();
  ASSERT_EQ(feed.maps.size(), 1U);
  for (std::size_t i = 0; i < feed.maps[0].scans.size(); ++i) {
    EXPECT_EQ(feed.maps[0].scans[i].unconfirmed_beams.empty(), i < before);
  }
}

TEST(LocalMapBuilder, SharesOneScanBetweenConsecutiveMaps) {
  Feed feed;
  feed.scan(Status::kFirstScan);
  for (int i = 0; i < 80; ++i) feed.step({0.15, 0.0, 0.05});
  ASSERT_GE(feed.maps.size(), 2U);
  const LocalMap& first = feed.maps[0];
  const LocalMap& second = feed.maps[1];
  EXPECT_EQ(first.scans.back().scan, second.scans.front().scan);
  EXPECT_EQ(second.scans.front().T_local_body, Pose2{});
  const Pose2 gap = between(first.T_odom_local * second.T_previous_local, second.T_odom_local);
  EXPECT_LT(gap.vector().norm(), 1e-12);
  const Pose2 end = between(second.T_previous_local, first.scans.back().T_local_body);
  EXPECT_LT(end.vector().norm(), 1e-12);
}

/// So that the 3D scan is at its origin, also where the body has not moved since the last stored
/// scan.
TEST(LocalMapBuilder, StartsAMapWhereA3DScanWasTaken) {
  Feed feed;
  feed.scan(Status::kFirstScan);
  for (int i = 0; i < 20; ++i) feed.step({0.15, 0.0, 0.0});
  feed.step({0.05, 0.0, 0.0});
  ASSERT_TRUE(feed.maps.empty());
  feed.builder().begin_at_next_scan();
  feed.scan(Status::kMatched);
  ASSERT_EQ(feed.maps.size(), 1U);
  EXPECT_NEAR(feed.builder().current().T_odom_local.x, 3.05, 1e-9);
  EXPECT_NEAR(feed.maps[0].scans.back().T_local_body.x, 3.05, 1e-9);
  for (int i = 0; i < 40; ++i) feed.step({0.1, 0.0, 0.0});
  EXPECT_EQ(feed.maps.size(), 1U);
}

TEST(LocalMapBuilder, StartsNoMapWhereTwo3DScansAreNearEachOther) {
  Feed feed;
  feed.scan(Status::kFirstScan);
  for (int i = 0; i < 6; ++i) feed.step({0.15, 0.0, 0.0});
  feed.builder().begin_at_next_scan();
  feed.scan(Status::kMatched);
  for (int i = 0; i < 6; ++i) feed.step({0.15, 0.0, 0.0});  // not later either
  EXPECT_TRUE(feed.maps.empty());
}

TEST(LocalMapBuilder, StoresAScanEveryTenthOfAMetreOrRadian) {
  Feed feed;
  feed.scan(Status::kFirstScan);
  for (int i = 0; i < 10; ++i) feed.step({0.03, 0.0, 0.0});  // stores the 4th and the 8th
  for (int i = 0; i < 10; ++i) feed.step({0.0, 0.0, 0.03});  // two more
  feed.finish();
  ASSERT_EQ(feed.maps.size(), 1U);
  EXPECT_EQ(feed.maps[0].scans.size(), 1U + 2U + 2U);
}

TEST(LocalMapBuilder, StoresTheScansOfEachLaser) {
  Feed feed;
  feed.scan(Status::kFirstScan);
  feed.scan(Status::kFirstScan, kRear);
  for (int i = 0; i < 10; ++i) {
    feed.step({0.11, 0.0, 0.0}, Status::kMatched, kFront);
    feed.scan(Status::kMatched, kRear);
  }
  feed.finish();
  ASSERT_EQ(feed.maps.size(), 1U);
  EXPECT_EQ(feed.maps[0].scans.size(), 22U);
}

TEST(LocalMapBuilder, PassesOnUnconfirmedBeamsAndRemovesGround) {
  LocalMapBuilder builder{LocalMapBuilderParams{}};
  builder.expect_ground();
  ScanMatch match;
  match.status = Status::kFirstScan;
  match.utime = 1'000'000'000;
  match.channel = kFront;
  match.ground_beams = {1};
  match.unconfirmed_beams = {0, 3};
  const LaserScan scan{match.utime, {4.0F, 5.0F, 6.0F, 7.0F}, -0.1, 0.1};
  EXPECT_FALSE(builder.add(kFront, scan, match));
  ASSERT_EQ(builder.current().scans.size(), 1U);
  const LocalScan& stored = builder.current().scans[0];
  EXPECT_EQ(stored.unconfirmed_beams, match.unconfirmed_beams);
  // Their ranges stay: the space in front of them is free whatever they hit.
  EXPECT_EQ(stored.scan.ranges_m, std::vector<float>({4.0F, 0.0F, 6.0F, 7.0F}));
}

TEST(LocalMapBuilder, MakesNoMapsAtRest) {
  Feed feed;
  feed.scan(Status::kFirstScan);
  for (int i = 0; i < 20'000; ++i) {
    feed.step({i % 2 == 0 ? 0.002 : -0.002, 0.0, i % 2 == 0 ? 0.001 : -0.001});
  }
  EXPECT_TRUE(feed.maps.empty());
  EXPECT_EQ(feed.builder().current().scans.size(), 1U);
}

TEST(LocalMapBuilder, FinishesAMapAfterTurningInPlace) {
  Feed feed;
  feed.scan(Status::kFirstScan);
  for (int i = 0; i < 65; ++i) feed.step({0.0, 0.0, 0.1});  // 6.5 rad
  EXPECT_EQ(feed.maps.size(), 1U);
}

TEST(LocalMapBuilder, SkipsLostScansAndIgnoresRejectedOnes) {
  Feed feed;
  feed.scan(Status::kFirstScan);
  for (int i = 0; i < 10; ++i) {
    feed.step({0.2, 0.0, 0.0}, Status::kLost);
    feed.step({0.2, 0.0, 0.0}, Status::kMatched);
    feed.scan(Status::kRejected);
  }
  feed.finish();
  ASSERT_EQ(feed.maps.size(), 1U);
  EXPECT_EQ(feed.maps[0].scans.size(), 11U);
}

TEST(LocalMapBuilder, StartsASessionForEachOdomFrame) {
  Feed feed;
  feed.scan(Status::kFirstScan);
  for (int i = 0; i < 20; ++i) feed.step({0.1, 0.0, 0.0});
  feed.restart();
  ASSERT_EQ(feed.maps.size(), 1U);  // the unfinished map is not lost
  EXPECT_EQ(feed.maps[0].id, 0);
  EXPECT_EQ(feed.maps[0].session, 0);
  EXPECT_EQ(feed.builder().current().id, 1);
  EXPECT_EQ(feed.builder().current().session, 1);
  EXPECT_EQ(feed.builder().current().scans.size(), 1U);
}

TEST(LocalMapBuilder, StartsALaterSessionWithAShortMap) {
  Feed feed(7, 2);
  feed.scan(Status::kFirstScan);
  for (int i = 0; i < 2; ++i) feed.step({});
  EXPECT_TRUE(feed.maps.empty());
  feed.step({});  // 0.6 s
  ASSERT_EQ(feed.maps.size(), 1U);
  EXPECT_EQ(feed.maps[0].id, 7);
  EXPECT_EQ(feed.maps[0].session, 2);
  EXPECT_EQ(feed.maps[0].scans.size(), 2U);
  for (int i = 0; i < 20; ++i) feed.step({});
  EXPECT_EQ(feed.maps.size(), 1U);
  for (int i = 0; i < 51; ++i) feed.step({0.1, 0.0, 0.0});
  ASSERT_EQ(feed.maps.size(), 2U);
  EXPECT_EQ(feed.maps[1].session, 2);
}

TEST(LocalMapBuilder, ReportsTheCovarianceOfADisplacement) {
  Feed feed;
  feed.scan(Status::kFirstScan);
  for (int i = 0; i < 80; ++i) feed.step({0.15, 0.0, 0.0});
  ASSERT_GE(feed.maps.size(), 2U);
  const Eigen::Matrix3d covariance = feed.maps[1].information.inverse();
  EXPECT_GT(std::sqrt(covariance(0, 0)), 0.003);  // more than a single match,
  EXPECT_LT(std::sqrt(covariance(0, 0)), 0.03);   // less than half a percent of the path length
  EXPECT_LT(rad_to_deg(std::sqrt(covariance(2, 2))), 0.3);
}

TEST(LocalMapBuilder, FinishesNothingBeforeTheFirstScan) {
  LocalMapBuilder builder{LocalMapBuilderParams{}};
  EXPECT_FALSE(builder.finish());
}

/// Standard deviation along the displacement to the second local map, if the wheels roll
/// `wheels_share` of what the scans measure over one of its five metres.
double displacement_sd(double wheels_share) {
  Feed feed;
  double wheels_m = 0.0;
  std::int64_t utime = 1'000'000'000;  // as of Feed
  for (int i = 0; i < 60; ++i) {
    feed.builder().add(WheelOdometry{utime, {wheels_m, 0.0, 0.0}});
    utime += 200'000;
    wheels_m += 0.1 * (i >= 10 && i < 20 ? wheels_share : 1.0);
    feed.builder().add(WheelOdometry{utime, {wheels_m, 0.0, 0.0}});
    feed.step({0.1, 0.0, 0.0});
  }
  feed.finish();
  return std::sqrt(feed.maps.at(1).information.inverse()(0, 0));
}

TEST(LocalMapBuilder, StatesASlipThatTheWheelsContradict) {
  EXPECT_LT(displacement_sd(1.0), 0.02);
  EXPECT_GT(2.448 * displacement_sd(0.6), 0.4);
}

/// A lidar that turns in 0.1 s, on a body that drives 0.5 m/s towards a wall 6 m away. Each beam of
/// the stored scan has to end on the wall as it was when the scan began.
TEST(LocalMapBuilder, StoresASlowScanWithoutTheMotionOfTheBody) {
  constexpr double kSpeedMS = 0.5;
  constexpr double kWallM = 6.0;
  constexpr int kBeams = 720;
  constexpr std::int32_t kGroundBeam = 350;
  constexpr std::int32_t kUnconfirmedBeam = 365;
  LaserMount mount;
  mount.T_body_laser = {};
  mount.field_of_view_rad = 2.0 * std::numbers::pi;
  mount.timing = {.mirror_hz = 10.0, .mirror_turns = 1, .clockwise = true};
  LocalMapBuilder builder({}, {{kFront, mount}});

  LaserScan scan;
  scan.utime = 1'200'000'000;
  scan.angle_step_rad = 2.0 * std::numbers::pi / kBeams;
  scan.angle_min_rad = -std::numbers::pi;
  for (int beam = 0; beam < kBeams; ++beam) {
    const double ahead = std::cos(scan.angle_min_rad + beam * scan.angle_step_rad);
    const double driven_m = kSpeedMS * mount.timing.beam_time_s(beam, kBeams, scan.angle_step_rad);
    scan.ranges_m.push_back(ahead > 0.5 ? static_cast<float>((kWallM - driven_m) / ahead) : 0.0F);
  }
  ScanMatch match;
  match.status = Status::kFirstScan;
  match.channel = kFront;
  match.utime = scan.utime;
  match.reference_utime = scan.utime - 100'000;
  match.T_reference_body = {0.1 * kSpeedMS, 0.0, 0.0};
  match.ground_beams = {kGroundBeam};
  match.unconfirmed_beams = {kUnconfirmedBeam};
  builder.expect_ground();
  builder.add(kFront, scan, match);

  ASSERT_EQ(builder.current().scans.size(), 1U);
  const LocalScan& stored = builder.current().scans.front();
  const auto ahead_m = [&](const LaserScan& of, int beam) {
    return of.ranges_m[static_cast<std::size_t>(beam)] *
           std::cos(of.angle_min_rad + beam * of.angle_step_rad);
  };
  EXPECT_GT(kWallM - ahead_m(scan, 300), 0.015);
  int on_wall = 0;
  for (int beam = 280; beam <= 440; ++beam) {
    const double measured_m = ahead_m(stored.scan, beam);
    if (!(measured_m > 0.0)) continue;
    ++on_wall;
    EXPECT_NEAR(measured_m, kWallM, 0.002) << beam;
  }
  EXPECT_NEAR(on_wall, 161, 3);
  EXPECT_FALSE(stored.scan.ranges_m[kGroundBeam] > 0.0F);
  ASSERT_FALSE(stored.unconfirmed_beams.empty());
  for (const std::int32_t beam : stored.unconfirmed_beams) EXPECT_NEAR(beam, kUnconfirmedBeam, 1);
}

}  // namespace
}  // namespace adit
