// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Beams of which no 3D scan shows whether they hit a wall.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "procs/scan_matching/scan_matching.hpp"
#include "tests/support/worlds/wall_world.hpp"

namespace adit {
namespace {

constexpr double kLaserM = 0.62;
constexpr double kEndM = 6.0;  // of the tunnel, from the start
constexpr double kHalfWidthM = 1.5;
constexpr std::int64_t kImuPeriod = 10'000;

test::WallWorld dead_end() {
  return test::WallWorld({{{-20.0, kHalfWidthM}, {kEndM, kHalfWidthM}},
                          {{-20.0, -kHalfWidthM}, {kEndM, -kHalfWidthM}},
                          {{kEndM, -kHalfWidthM}, {kEndM, kHalfWidthM}}});
}

/// Level ground up to x = `to_m`, and from `rock_m` on rock of 1.9 m.
TerrainMap level_ground(double to_m, double rock_m = 1e3) {
  constexpr double kBehindM = 2.0;
  TerrainMap map;
  map.p_level_corner = {-kBehindM, -2.0};
  map.cell_m = 0.1;
  map.cells = Grid2<TerrainCell>(static_cast<int>(std::lround((to_m + kBehindM) / map.cell_m)), 40);
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const Eigen::Vector2i at = map.cells.cell(i);
    TerrainCell& cell = map.cells[i];
    cell.ground = Ground::kObserved;
    cell.coefficient_m = map.centre(at.x(), at.y()).x() > rock_m ? 1.9F : 0.02F;
    cell.clearance_m = 3.0F;
  }
  return map;
}

/// A body with a laser at 0.62 m, an IMU and wheels.
class Body {
 public:
  Body() { turn(0.0, 100); }

  /// `periods` of the IMU at a pitch rate [rad/s].
  void turn(double pitch_rate, int periods) {
    for (int i = 0; i < periods; ++i) {
      utime_ += kImuPeriod;
      pitch_rad_ += 1e-6 * static_cast<double>(kImuPeriod) * pitch_rate;
      matching_.add(ImuReading{utime_,
                               {0.0, pitch_rate, 0.0},
                               {-9.81 * std::sin(pitch_rad_), 0.0, 9.81 * std::cos(pitch_rad_)}});
    }
  }
  void add(TerrainMap terrain) { matching_.add(std::move(terrain)); }
  /// `wheels_scale`: metres of the wheels per metre.
  ScanMatch scan_at(double x_m, double wheels_scale = 1.0) {
    turn(0.0, 20);
    matching_.add(WheelOdometry{utime_, {wheels_scale * x_m, 0.0, 0.0}});
    return matching_.add_scan(LaserId::kFront, laser_.measure({x_m, 0.0, 0.0}, utime_));
  }

 private:
  static ScanMatchingParams params() {
    ScanMatchingParams params;
    params.lasers.front.height_m = kLaserM;
    return params;
  }

  ScanMatching matching_{params()};
  test::LevelLaser laser_{dead_end(), 1};
  std::int64_t utime_ = 1'000'000'000;
  double pitch_rad_ = 0.0;
};

/// The beams at 1° to the end of the tunnel, with a margin of one beam at the corners.
std::vector<std::int32_t> beams_to_the_end(double x_m) {
  const double corner_deg = std::atan2(kHalfWidthM, kEndM - x_m) * 180.0 / M_PI;
  std::vector<std::int32_t> beams;
  for (std::int32_t i = 0; i < 181; ++i) {
    if (std::abs(i - 90) < corner_deg - 1.0) beams.push_back(i);
  }
  return beams;
}

void expect_end_unconfirmed(const ScanMatch& match, double x_m) {
  const std::vector<std::int32_t> end = beams_to_the_end(x_m);
  const auto& listed = match.unconfirmed_beams;
  EXPECT_TRUE(std::ranges::is_sorted(listed));
  EXPECT_TRUE(std::ranges::includes(listed, end));
  // Not the side walls, but for the corners, where normals are those of both walls.
  constexpr std::int32_t kCornerBeams = 4;
  ASSERT_FALSE(listed.empty());
  EXPECT_GE(listed.front(), end.front() - kCornerBeams);
  EXPECT_LE(listed.back(), end.back() + kCornerBeams);
}

TEST(UnconfirmedBeams, AreThoseAheadBeforeTheFirst3DScan) {
  Body body;
  expect_end_unconfirmed(body.scan_at(0.0), 0.0);
  const ScanMatch match = body.scan_at(0.2);
  EXPECT_EQ(match.status, ScanMatch::Status::kMatched);
  expect_end_unconfirmed(match, 0.2);
}

TEST(UnconfirmedBeams, AreThoseAheadBeyondTheTerrain) {
  Body body;
  body.scan_at(0.0);
  body.add(level_ground(4.0));
  const ScanMatch match = body.scan_at(0.0);
  expect_end_unconfirmed(match, 0.0);
  EXPECT_TRUE(match.ground_beams.empty());
}

/// Where the end meets the side walls the terrain shows obstacles, which are these walls.
TEST(UnconfirmedBeams, AreAllOfOneSurfaceAlsoBesideASideWall) {
  TerrainMap terrain = level_ground(8.0);
  for (std::size_t i = 0; i < terrain.cells.size(); ++i) {
    const Eigen::Vector2i at = terrain.cells.cell(i);
    const Eigen::Vector2d p = terrain.centre(at.x(), at.y());
    if (p.x() < 4.0) continue;
    const bool beside_wall = std::abs(p.y()) > kHalfWidthM - 0.35;
    terrain.cells[i].coefficient_m = beside_wall ? 1.9F : 0.02F;
    if (!beside_wall) terrain.cells[i].ground = Ground::kNeverObserved;
  }
  Body body;
  body.scan_at(0.0);
  body.add(std::move(terrain));
  const ScanMatch match = body.scan_at(0.0);
  for (const std::int32_t beam :
       {78, 79, 80, 90, 100, 101, 102}) {  // the corners are at 76 and 104
    EXPECT_TRUE(std::ranges::binary_search(match.unconfirmed_beams, beam)) << beam;
  }
}

TEST(UnconfirmedBeams, AreNotThoseToObservedRock) {
  Body body;
  body.scan_at(0.0);
  body.add(level_ground(8.0, kEndM - 0.5));
  EXPECT_THAT(body.scan_at(0.0).unconfirmed_beams, testing::IsEmpty());
}

TEST(UnconfirmedBeams, AreNotThoseNearerThanGroundCanBe) {
  // The laser is at 0.62 m: a grade of 35 % reaches it after 1.77 m.
  Body body;
  for (double x_m = 0.0; x_m < kEndM - 1.7; x_m += 0.2) body.scan_at(x_m);
  body.add(level_ground(1.0));
  EXPECT_TRUE(body.scan_at(kEndM - 1.6).unconfirmed_beams.empty());
}

TEST(UnconfirmedBeams, AreNotThoseToWhatWasSeenInOnePlaceAtDifferentHeights) {
  Body body;
  body.scan_at(0.0);
  body.add(level_ground(3.0));
  expect_end_unconfirmed(body.scan_at(0.05), 0.05);
  body.turn(0.08, 100);  // 0.08 rad: at 6 m the beams are 0.5 m lower
  for (int i = 1; i <= 5; ++i) body.scan_at(0.2 * i);
  // In the reference the wall ahead has both heights now. Where the beams of the first scan are far
  // apart some of it has one.
  const ScanMatch match = body.scan_at(1.2);
  const auto left = static_cast<double>(match.unconfirmed_beams.size());
  EXPECT_LT(left, 0.4 * static_cast<double>(beams_to_the_end(1.2).size()));
}

/// Once the end of a smooth tunnel is known to be rock, it shows the error of the wheels.
TEST(UnconfirmedBeams, ThatAreConfirmedMeasureTheScaleOfTheWheels) {
  constexpr double kScale = 1.06;
  Body body;
  body.scan_at(0.0);
  body.add(level_ground(1.0));
  EXPECT_GT(body.scan_at(0.02, kScale).wheels_scale_sd, 0.04);
  body.add(level_ground(8.0, kEndM - 0.7));
  ScanMatch match;
  for (double x_m = 0.04; x_m < 4.2; x_m += 0.02) match = body.scan_at(x_m, kScale);
  EXPECT_NEAR(match.T_odom_body.x, 4.2, 0.05);
  EXPECT_LT(match.wheels_scale_sd, 0.03);
}

}  // namespace
}  // namespace adit
