// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/registration/surface_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

/// 181 beams over a half circle towards a wall, x = `distance` in the laser frame.
LaserScan wall_ahead(double distance) {
  LaserScan scan{1'000'000, {}, -kPi / 2, kPi / 180};
  for (int i = 0; i < 181; ++i) {
    const double range = distance / std::cos(scan.angle_min_rad + i * scan.angle_step_rad);
    scan.ranges_m.push_back(range < 20.0 && range > 0.0 ? static_cast<float>(range) : 81.83F);
  }
  return scan;
}

TEST(SurfacePoints, LieOnTheWallWithNormalsTowardsTheLaser) {
  const auto points = surface_points(wall_ahead(3.0), LaserMount{}, SurfaceParams{});
  ASSERT_GT(points.size(), 100U);
  for (const auto& point : points) {
    EXPECT_NEAR(point.p.x(), 3.0, 1e-5);  // ranges are floats
    if (!point.has_normal()) continue;
    EXPECT_NEAR(point.normal.x(), -1.0, 1e-4);
  }
  EXPECT_TRUE(points[points.size() / 2].has_normal());
}

TEST(SurfacePoints, AreInTheBodyFrame) {
  LaserMount rear;
  rear.T_body_laser = {-1.0, 0.5, kPi};
  const auto points = surface_points(wall_ahead(3.0), rear, SurfaceParams{});
  const auto& ahead = points[points.size() / 2];
  EXPECT_NEAR(ahead.p.x(), -4.0, 1e-5);
  EXPECT_NEAR(ahead.p.y(), 0.5, 1e-5);
  EXPECT_NEAR(ahead.normal.x(), 1.0, 1e-4);
}

TEST(SurfacePoints, DiscardInvalidReadings) {
  LaserScan scan = wall_ahead(3.0);
  const std::size_t good = surface_points(scan, LaserMount{}, SurfaceParams{}).size();
  scan.ranges_m[80] = kNan;
  scan.ranges_m[85] = kInf;
  scan.ranges_m[90] = -kInf;
  scan.ranges_m[95] = 0.0F;
  scan.ranges_m[100] = -2.0F;
  scan.ranges_m[105] = 1000.0F;
  const auto points = surface_points(scan, LaserMount{}, SurfaceParams{});
  EXPECT_EQ(points.size(), good - 6);
  for (const auto& point : points) EXPECT_TRUE(point.p.allFinite() && point.normal.allFinite());
}

TEST(SurfacePoints, AreEmptyForAnEmptyScan) {
  EXPECT_TRUE(surface_points(LaserScan{}, LaserMount{}, SurfaceParams{}).empty());
}

TEST(SurfacePoints, DiscardAMixedPixelBetweenAPostAndTheWallBehind) {
  LaserScan scan = wall_ahead(6.0);
  for (int i = 88; i <= 92; ++i) scan.ranges_m[i] = 2.0F;  // a post
  scan.ranges_m[93] = 4.0F;                                // its edge: half on the wall
  for (const auto& point : surface_points(scan, LaserMount{}, SurfaceParams{})) {
    EXPECT_GT(std::abs(point.p.norm() - 4.0), 0.5);
  }
}

TEST(SurfacePoints, KeepAThinPostOfOneBeam) {
  LaserScan scan = wall_ahead(6.0);
  scan.ranges_m[90] = 2.0F;  // nearer than both neighbours: not between them
  const auto points = surface_points(scan, LaserMount{}, SurfaceParams{});
  const auto post = std::find_if(points.begin(), points.end(), [](const auto& point) {
    return std::abs(point.p.x() - 2.0) < 1e-6;
  });
  ASSERT_NE(post, points.end());
  EXPECT_FALSE(post->has_normal());
}

TEST(SurfacePoints, AreLessCertainOnADistantWallAtAGrazingAngle) {
  LaserScan scan{1'000'000, {}, 0.0, kPi / 180};
  for (int i = 0; i < 91; ++i) {  // a wall beside the laser, y = 1
    const double sine = std::sin(i * scan.angle_step_rad);
    scan.ranges_m.push_back(sine > 0.05 ? static_cast<float>(1.0 / sine) : 81.83F);
  }
  const auto points = surface_points(scan, LaserMount{}, SurfaceParams{});
  const SurfaceParams params;
  const double head_on = params.range_sd_m * params.range_sd_m;
  EXPECT_NEAR(points.back().variance, head_on, 0.01 * head_on);
  EXPECT_GT(points.front().variance,
            5.0 * head_on);  // 19 m away at 3°: the bearing error dominates
}

/// The scan of a laser at this height on a tilted body, 5 m before a vertical wall across x.
LaserScan tilted_scan_of_wall(const Attitude& attitude, double height_m) {
  LaserScan scan;
  scan.angle_min_rad = -0.6;
  scan.angle_step_rad = 0.01;
  const Eigen::Matrix3d R = attitude.rotation();
  const Eigen::Vector3d origin = R * Eigen::Vector3d(0.0, 0.0, height_m);
  for (int i = 0; i < 121; ++i) {
    const double angle = scan.angle_min_rad + i * scan.angle_step_rad;
    const Eigen::Vector3d beam = R * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0);
    scan.ranges_m.push_back(static_cast<float>((5.0 - origin.x()) / beam.x()));
  }
  return scan;
}

TEST(SurfacePoints, OfAVerticalWallDoNotDependOnTheAttitude) {
  for (const Attitude attitude : {Attitude{0.1, 0.0}, {0.0, 0.2}, {-0.15, -0.25}}) {
    LaserMount mount;
    mount.height_m = 0.63;
    const auto points = surface_points(tilted_scan_of_wall(attitude, mount.height_m), mount,
                                       SurfaceParams{}, attitude);
    ASSERT_EQ(points.size(), 121U);
    for (const SurfacePoint& point : points) {
      EXPECT_NEAR(point.p.x(), 5.0, 1e-5);  // ranges are floats
      const double rise = ground_slope(attitude).dot(point.p);
      const double plane_m = 0.63 / std::cos(attitude.roll_rad) / std::cos(attitude.pitch_rad);
      EXPECT_NEAR(point.z_m, plane_m + rise, 1e-5);
      if (point.has_normal()) {
        EXPECT_NEAR(point.normal.x(), -1.0, 1e-6);
      }
    }
  }
}

/// Between smooth walls beside the laser, with noise, normals have a part along the walls that
/// tells nothing of a motion along them. Its mean square, over the points by their weights.
double along_smooth_walls(double step_rad) {
  constexpr double kHalfWidthM = 1.5;
  constexpr double kNoiseM = 0.01;
  std::mt19937 random(5);
  std::normal_distribution<double> noise_m(0.0, kNoiseM);
  double sum = 0.0;
  double weights = 0.0;
  for (int i = 0; i < 20; ++i) {
    LaserScan scan{1'000'000, {}, -0.75 * kPi, step_rad};
    for (double bearing = -0.75 * kPi; bearing <= 0.75 * kPi; bearing += step_rad) {
      const double range_m = kHalfWidthM / std::abs(std::sin(bearing));
      scan.ranges_m.push_back(range_m < 8.0 ? static_cast<float>(range_m + noise_m(random)) : kNan);
    }
    for (const auto& point : surface_points(scan, LaserMount{}, SurfaceParams{})) {
      if (!point.has_normal()) continue;
      sum += point.weight * point.normal.x() * point.normal.x();
      weights += point.weight;
    }
  }
  return sum / weights;
}

/// With the same number of beams, those of a Hokuyo UTM-30LX gave normals four times as noisy; scan
/// matching then measured 5 % too little motion.
TEST(SurfacePoints, HaveNoNoisierNormalsOfFinerBeams) {
  const double of_half_a_degree = along_smooth_walls(0.5 * kPi / 180.0);
  EXPECT_LT(along_smooth_walls(0.25 * kPi / 180.0), of_half_a_degree);
  EXPECT_LT(along_smooth_walls(0.36 * kPi / 180.0), of_half_a_degree);
}

}  // namespace
}  // namespace adit
