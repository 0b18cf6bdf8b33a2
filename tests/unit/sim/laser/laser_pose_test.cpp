// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Poses and motion of the laser, against closed forms.
#include <cmath>

#include <gtest/gtest.h>

#include "common/sensing/laser_mount.hpp"
#include "tests/unit/sim/laser/laser_fixture.hpp"

namespace adit {
namespace {

TEST(LaserModel, TiltedOnItsLeverMeasuresTheFloorToAMillimetre) {
  const World world = box_tunnel({40.0, 40.0, 3.0});
  const RayScene scene(world.mesh);
  LaserModel laser(scene, perfect_laser(), 1);
  const LaserMount mount{
      .T_body_laser = {1.05, 0.0, 0.0}, .height_m = 0.62, .lever_x_m = 0.06, .lever_z_m = 0.08};
  for (const double tilt : {0.1, 0.25, 0.4, 0.52}) {
    const LaserScan scan = scan_at_rest(laser, tilted_laser(mount, tilt));
    // The laser moves about the fixed axis of tilt, forward and down.
    const double height = 0.62 - 0.08 + 0.08 * std::cos(tilt) - 0.06 * std::sin(tilt);
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      const double range = height / (std::sin(tilt) * std::cos(beam_angle(scan, i)));
      if (range > 8.0) continue;
      EXPECT_NEAR(scan.ranges_m[i], range, kHalfMillimetre) << tilt << " " << i;
    }
  }
}

/// A wall across x, measured by a laser that moves along x and turns.
double range_in_motion(double wall_x, double speed, double turn_rate, double seconds,
                       double angle) {
  return (wall_x - speed * seconds) / std::cos(angle + turn_rate * seconds);
}

TEST(LaserModel, MotionDistortsAWallByTheTimesOfTheBeams) {
  const World world = box_tunnel({12.0, 40.0, 2.0});
  const RayScene scene(world.mesh);
  constexpr double kSpeed = 2.0;
  constexpr double kTurnRate = 1.0;
  const auto pose = [](double seconds) {
    return laser_at({kSpeed * seconds, 0.0, 1.0}, kTurnRate * seconds);
  };
  for (const int beams : {181, 361}) {
    LaserParams params = perfect_laser();
    params.beams = beams;
    LaserModel laser(scene, params, 1);
    const LaserScan scan = laser.measure(pose, 0);
    double most_bent = 0.0;
    for (int i = 0; i < beams; ++i) {
      const double degrees = i * 180.0 / (beams - 1);
      // One mirror, 75 turns a second; of 361 beams every other one is measured a turn later.
      const double turn = beams == 361 ? i % 2 : 0;
      const double seconds = (turn + degrees / 360.0) / 75.0;
      const double angle = beam_angle(scan, static_cast<std::size_t>(i));
      if (std::abs(angle) > 0.7) continue;  // beyond, the wall is out of range
      const double range = range_in_motion(6.0, kSpeed, kTurnRate, seconds, angle);
      EXPECT_NEAR(scan.ranges_m[static_cast<std::size_t>(i)], range, kHalfMillimetre) << i;
      most_bent = std::max(most_bent, std::abs(range - 6.0 / std::cos(angle)));
    }
    EXPECT_GT(most_bent, 0.01);
  }
}

TEST(LaserModel, InterpolatesAFastTurnToAMillimetre) {
  const World world = box_tunnel({12.0, 12.0, 2.0});
  const RayScene scene(world.mesh);
  LaserModel laser(scene, perfect_laser(), 1);
  const auto pose = [](double seconds) { return laser_at({0.0, 0.0, 1.0}, 5.0 * seconds); };
  const LaserScan scan = laser.measure(pose, 0);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double seconds = (static_cast<double>(i % 2) + static_cast<double>(i) / 720.0) / 75.0;
    const double range = range_in_rectangle(12.0, 12.0, beam_angle(scan, i) + 5.0 * seconds);
    if (range > 8.19) continue;
    EXPECT_NEAR(scan.ranges_m[i], range, 0.001) << i;
  }
}

TEST(LaserModel, StillWaterReflectsTheRoof) {
  const double level = 0.1;
  const World world = box_tunnel({60.0, 60.0, 2.0}, [level](MeshBuilder& builder) {
    builder.begin_part(PartKind::kWater, Material::kMirror, "water");
    builder.box(level_box({0.0, 0.0, level - 0.05}, {60.0, 60.0, 0.1}));
  });
  const RayScene scene(world.mesh);
  LaserParams params = perfect_laser();
  params.unit_m = 0.01;
  for (const int subrays : {1, 9}) {
    params.subrays = subrays;
    LaserModel laser(scene, params, 1);
    for (const double tilt : {0.15, 0.3, 0.5}) {
      const LaserScan scan = scan_at_rest(laser, laser_at({0.0, 0.0, 0.62}, 0.0, tilt));
      for (std::size_t i = 120; i <= 240; ++i) {
        const double down = std::sin(tilt) * std::cos(beam_angle(scan, i));
        const double image = level - (2.0 - level);
        const double range = (0.62 - image) / down;
        if (range > 17.0) continue;  // beams nine rays wide spread over more than a pulse there
        // Half a unit; over the width of a beam the range varies, and with it the power.
        EXPECT_NEAR(scan.ranges_m[i], range, subrays == 1 ? 0.0051 : 0.0151) << tilt << " " << i;
      }
    }
  }
}

TEST(LaserModel, StillWaterReflectsLessAtSteeperIncidence) {
  const World world = box_tunnel({400.0, 400.0, 2.0}, [](MeshBuilder& builder) {
    builder.begin_part(PartKind::kWater, Material::kMirror, "water");
    builder.box(level_box({0.0, 0.0, 0.0}, {400.0, 400.0, 0.1}));
  });
  const RayScene scene(world.mesh);
  LaserParams params = perfect_laser();
  params.unit_m = 0.01;
  params.range_at_10_percent_m = 60.0;
  LaserModel laser(scene, params, 1);
  int merge = 0;
  for (double tilt = 0.1; tilt < 1.4; tilt += 0.01) {
    const LaserScan scan = scan_at_rest(laser, laser_at({0.0, 0.0, 0.65}, 0.0, tilt));
    const double cosine = std::sin(tilt);  // onto the water, and onto the roof
    const double range = (0.6 + 1.95) / cosine;
    const double mirrored = 0.02 + 0.98 * std::pow(1.0 - cosine, 5.0);
    const double power = mirrored * mirrored * 0.25 * cosine / (range * range);
    const double share = power / (0.1 / (60.0 * 60.0));
    if (std::abs(share - 1.0) < 0.01) continue;  // rounding
    EXPECT_EQ(scan.ranges_m[180]<81.9F, share> 1.0) << tilt;
    merge += share > 1.0 ? 1 : 0;
  }
  EXPECT_GT(merge, 10);
  EXPECT_LT(merge, 120);
}

}  // namespace
}  // namespace adit
