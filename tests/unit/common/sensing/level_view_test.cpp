// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/sensing/level_view.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <tuple>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;
constexpr float kInfinite = std::numeric_limits<float>::infinity();

Lasers pitched(double pitch_rad) {
  Lasers lasers;
  lasers.count = 1;
  lasers.front.range_max_m = 100.0;
  lasers.lidar = {true, pitch_rad, 900};
  return lasers;
}

/// Range along a direction in the level frame, from the lidar.
using Range = std::function<double(const Eigen::Vector3d&)>;

/// A revolution of rings from −15° to 15°, two degrees apart, whose rings fire one after the other.
LidarRevolution revolution_of(const Lasers& lasers, const Range& range_m, int columns = 904) {
  LidarRevolution revolution;
  for (int i = 0; i < 16; ++i) {
    revolution.rings.push_back(
        {static_cast<float>((2 * i - 15) * kDeg), -0.0002F * static_cast<float>(i % 5), 0.0F});
  }
  const Eigen::AngleAxisd R_level_lidar(lasers.lidar.pitch_rad, Eigen::Vector3d::UnitY());
  for (int i = 0; i < columns; ++i) {
    revolution.columns.push_back(
        {i, static_cast<float>(std::numbers::pi - 0.001 - 2.0 * std::numbers::pi * i / columns)});
    for (std::size_t j = 0; j < 16; ++j) {
      const Eigen::Vector3d d =
          R_level_lidar * revolution.direction(revolution.columns.size() - 1, j);
      revolution.ranges_m.push_back(static_cast<float>(range_m(d)));
    }
  }
  return revolution;
}

/// A room of upright walls, 6 m × 4 m, without floor and roof, the lidar 1 m from its middle.
double room(const Eigen::Vector3d& d) {
  const double x_m = (d.x() > 0.0 ? 2.0 : 4.0) / std::max(1e-9, std::abs(d.x()));
  const double y_m = 2.0 / std::max(1e-9, std::abs(d.y()));
  return std::min(x_m, y_m);
}

class LevelViewOf : public testing::TestWithParam<double> {};

TEST_P(LevelViewOf, UprightWallsIsThatOfALevelLaser) {
  const Lasers lasers = pitched(GetParam());
  LevelView view(lasers);
  const LaserScan scan = view.scan(revolution_of(lasers, room));
  ASSERT_EQ(scan.ranges_m.size(), 900U);
  int far_off = 0;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double bearing = scan.angle_min_rad + static_cast<double>(i) * scan.angle_step_rad;
    const double true_m = room({std::cos(bearing), std::sin(bearing), 0.0});
    if (std::abs(scan.ranges_m[i] - true_m) > 0.002)
      ++far_off;  // float, and columns around a corner
  }
  EXPECT_LE(far_off, 8);  // two beams at each corner
}

INSTANTIATE_TEST_SUITE_P(Pitch, LevelViewOf, testing::Values(0.0, 0.1, 0.21, -0.2));

TEST(LevelView, KeepsANearObstacleThatOneRingHits) {
  const Lasers lasers = pitched(0.0);
  // A block at 2 m ahead whose top is 1 cm below level: the ring below it hits it, 3.5 cm lower.
  const auto block = [](const Eigen::Vector3d& d) {
    const bool hits = d.x() > 0.95 && 2.0 * d.z() / d.x() < -0.01;
    return hits ? 2.0 / d.x() : room(d) + 5.0;
  };
  LevelView view(lasers);
  const LaserScan scan = view.scan(revolution_of(lasers, block));
  EXPECT_NEAR(scan.ranges_m[450], 2.0, 0.01);
}

TEST(LevelView, LeavesOutGroundFarBelowIt) {
  const Lasers lasers = pitched(0.0);
  // The ring 1° below level meets the ground 0.7 m below after 40 m, those above it a wall at 60 m.
  const auto ground = [](const Eigen::Vector3d& d) {
    const double ground_m = d.z() < 0.0 ? 0.7 / -d.z() : 1e9;
    return std::min(ground_m, 60.0 / std::hypot(d.x(), d.y()));
  };
  LevelView view(lasers);
  const LaserScan scan = view.scan(revolution_of(lasers, ground));
  for (const float range_m : scan.ranges_m) ASSERT_TRUE(std::isnan(range_m));
}

TEST(LevelView, ShowsTheFaceOfAHeapOnlyNearIt) {
  for (const double pitch : {0.0, 0.21, 13.0 * kDeg}) {
    const Lasers lasers = pitched(pitch);
    LevelView view(lasers);
    // Of 45°, level with the lidar at this distance ahead; on all sides walls at 20 m.
    const auto heap_at = [](double distance_m) {
      return [=](const Eigen::Vector3d& d) {
        const double closing = d.x() - d.z();
        const double heap_m = closing > 1e-9 ? distance_m / closing : 1e9;
        return std::min(heap_m, 20.0 / std::hypot(d.x(), d.y()));
      };
    };
    EXPECT_TRUE(std::isnan(view.scan(revolution_of(lasers, heap_at(5.0))).ranges_m[450])) << pitch;
    EXPECT_NEAR(view.scan(revolution_of(lasers, heap_at(2.0))).ranges_m[450], 2.0, 0.02) << pitch;
  }
}

/// Range to ground that rises, or to a roof that falls, from 4 m ahead on, and to the walls of a
/// tunnel 3 m wide.
double slope_in_tunnel(const Eigen::Vector3d& d, double grade) {
  // Up to the plane z = grade (x - 4) - 0.7, or its mirror image above.
  const double height_m = 0.7 + 4.0 * std::abs(grade);
  const double closing = grade > 0.0 ? grade * d.x() - d.z() : -grade * d.x() + d.z();
  const double slope_m = closing > 1e-9 ? height_m / closing : 1e9;
  return std::min(slope_m, 1.5 / std::max(1e-9, std::abs(d.y())));
}

class LevelViewOfSlope : public testing::TestWithParam<std::tuple<double, double>> {};

TEST_P(LevelViewOfSlope, ShowsNoLineThatMovesWithTheRobot) {
  const auto [pitch, grade] = GetParam();
  const Lasers lasers = pitched(pitch);
  LevelView view(lasers);
  const auto range = [grade = grade](const Eigen::Vector3d& d) {
    return slope_in_tunnel(d, grade);
  };
  const LaserScan scan = view.scan(revolution_of(lasers, range));
  const double slope_at_m = 4.0 + 0.7 / std::abs(grade);  // level ahead
  int walls = 0;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (!(scan.ranges_m[i] < 40.0F)) continue;  // NaN too
    const double bearing = scan.angle_min_rad + static_cast<double>(i) * scan.angle_step_rad;
    const double x_m = scan.ranges_m[i] * std::cos(bearing);
    const double y_m = scan.ranges_m[i] * std::sin(bearing);
    const double off_m = std::min(std::abs(std::abs(y_m) - 1.5), std::abs(x_m - slope_at_m));
    // A ring that is level within 0.1° meets a slope of 1 : 10 at 11 m 0.2 m too near or too far.
    ASSERT_LT(off_m, 0.25) << bearing << " rad, " << scan.ranges_m[i] << " m";
    ++walls;
  }
  EXPECT_GT(walls, 600);
}

INSTANTIATE_TEST_SUITE_P(PitchAndGrade, LevelViewOfSlope,
                         testing::Combine(testing::Values(0.0, 0.1, 0.21),
                                          testing::Values(0.1, 0.2, 0.5, -0.2, -0.5)));

TEST(LevelView, DistinguishesNoReturnFromNoReading) {
  const Lasers lasers = pitched(0.0);
  LevelView view(lasers);
  LidarRevolution revolution = revolution_of(lasers, [](const auto&) { return kInfinite; });
  for (const float range_m : view.scan(revolution).ranges_m) ASSERT_GE(range_m, 100.0F);
  // The packets of a sector ahead are lost.
  constexpr int kFirst = 430;
  revolution.columns.erase(revolution.columns.begin() + kFirst, revolution.columns.begin() + 480);
  revolution.ranges_m.erase(revolution.ranges_m.begin() + kFirst * 16,
                            revolution.ranges_m.begin() + 480 * 16);
  const LaserScan scan = view.scan(revolution);
  EXPECT_NEAR(std::ranges::count_if(scan.ranges_m, [](float r) { return std::isnan(r); }), 50, 3);
  EXPECT_TRUE(std::isnan(scan.ranges_m[450]));
}

TEST(LevelView, NamesTheReadingsThatItNeeds) {
  const Lasers lasers = pitched(0.21);
  LevelView view(lasers);
  LidarRevolution revolution = revolution_of(lasers, room);
  const LaserScan all = view.scan(revolution);
  const std::vector<bool> used = view.readings_used(revolution);
  EXPECT_LT(std::ranges::count(used, true), 4 * 904);
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) revolution.ranges_m[i] = std::numeric_limits<float>::quiet_NaN();
  }
  EXPECT_EQ(view.scan(revolution), all);
}

TEST(LevelView, CountsBeamsWithoutRing) {
  const auto rings = revolution_of(pitched(0.0), room, 1).rings;
  EXPECT_EQ(LevelView(pitched(0.21)).beams_without_ring(rings), 0);
  EXPECT_GT(LevelView(pitched(0.4)).beams_without_ring(rings), 100);
}

}  // namespace
}  // namespace adit
