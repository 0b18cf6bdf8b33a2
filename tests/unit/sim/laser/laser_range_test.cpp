// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Ranges, their errors and their limits, against closed forms in a tunnel of flat walls.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/laser/echo.hpp"
#include "tests/unit/sim/laser/laser_fixture.hpp"

namespace adit {
namespace {

const Eigen::Vector3d kMiddle(0.0, 0.0, 1.0);

TEST(LaserModel, MeasuresWallsWithinItsErrors) {
  const World world = box_tunnel({40.0, 4.0, 2.0});
  const RayScene scene(world.mesh);
  for (const int beams : {181, 361}) {
    LaserParams params;
    params.beams = beams;
    params.range_at_10_percent_m = 1000.0;  // walls return at any incidence
    LaserModel laser(scene, params, 3);
    EXPECT_LE(std::abs(laser.offset_m()), params.offset_max_m);
    const LaserScan scan = scan_at_rest(laser, laser_at(kMiddle));
    ASSERT_EQ(scan.ranges_m.size(), static_cast<std::size_t>(beams));
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      const double range = range_in_rectangle(40.0, 4.0, beam_angle(scan, i));
      // Five standard deviations, the greatest offset and half a unit.
      const double bound = 5.0 * params.noise_sd_m + params.offset_max_m + params.unit_m / 2.0;
      EXPECT_NEAR(scan.ranges_m[i], range, bound) << i;
    }
  }
}

TEST(LaserModel, MeasuresAnyFieldOfViewWithManyBeams) {
  const World world = box_tunnel({12.0, 6.0, 2.0});
  const RayScene scene(world.mesh);
  LaserParams params = perfect_laser();
  params.reading_max = 65'535;
  params.timing = {.mirror_hz = 40.0, .mirror_turns = 1};
  for (const double degrees : {270.0, 360.0, 100.0}) {
    for (const int beams : {1081, 4096}) {
      params.field_of_view_rad = deg_to_rad(degrees);
      params.beams = beams;
      LaserModel laser(scene, params, 1);
      const LaserScan scan = scan_at_rest(laser, laser_at(kMiddle));
      ASSERT_EQ(scan.ranges_m.size(), static_cast<std::size_t>(beams));
      EXPECT_NEAR(beam_angle(scan, scan.ranges_m.size() - 1), deg_to_rad(degrees / 2.0), 1e-9);
      for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
        const double range = range_in_rectangle(12.0, 6.0, beam_angle(scan, i));
        EXPECT_NEAR(scan.ranges_m[i], range, kHalfMillimetre) << degrees << " " << i;
      }
    }
  }
}

TEST(LaserModel, PlacesEachBeamOfAWideScanAtItsTime) {
  const World world = box_tunnel({12.0, 6.0, 2.0});
  const RayScene scene(world.mesh);
  LaserParams params = perfect_laser();
  params.field_of_view_rad = deg_to_rad(270.0);
  params.beams = 1081;
  params.timing = {.mirror_hz = 40.0, .mirror_turns = 1};
  LaserModel laser(scene, params, 1);
  constexpr double kRate = 1.0;  // [rad/s]
  const LaserScan scan =
      laser.measure([&](double seconds) { return laser_at(kMiddle, kRate * seconds); }, 0);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double yaw = kRate * params.timing.beam_time_s(static_cast<int>(i),
                                                         static_cast<int>(scan.ranges_m.size()),
                                                         scan.angle_step_rad);
    const double range = range_in_rectangle(12.0, 6.0, beam_angle(scan, i) + yaw);
    EXPECT_NEAR(scan.ranges_m[i], range, 0.001) << i;  // and the interpolation between knots
  }
}

TEST(LaserModel, NoiseHasTheConfiguredMeanAndDeviation) {
  const World world = box_tunnel({12.0, 6.0, 2.0});
  const RayScene scene(world.mesh);
  LaserParams params = perfect_laser();
  params.noise_sd_m = 0.005;
  params.offset_max_m = 0.015;
  LaserModel laser(scene, params, 5);
  constexpr int kScans = 1000;
  std::vector<double> sum(361);
  double squares = 0.0;
  for (int k = 0; k < kScans; ++k) {
    const LaserScan scan = scan_at_rest(laser, laser_at(kMiddle));
    for (std::size_t i = 0; i < sum.size(); ++i) {
      const double error =
          scan.ranges_m[i] - laser.offset_m() - range_in_rectangle(12.0, 6.0, beam_angle(scan, i));
      sum[i] += error;
      squares += error * error;
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i) {
    EXPECT_NEAR(sum[i] / kScans, 0.0, 0.001) << i;  // six standard deviations of such a mean
  }
  const double n = kScans * static_cast<double>(sum.size());
  const double variance = 0.005 * 0.005 + 0.001 * 0.001 / 12.0;  // of the noise and the rounding
  // n times the ratio is distributed as χ² with n degrees of freedom: mean n, variance 2n.
  EXPECT_NEAR(squares / n / variance, 1.0, 5.0 * std::sqrt(2.0 / n));
}

TEST(LaserModel, OffsetsAreUniformWithinTheirBounds) {
  const TriangleMesh nothing;
  const RayScene scene(nothing);
  double least = 1.0;
  double greatest = -1.0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const double offset = LaserModel(scene, {}, seed).offset_m();
    least = std::min(least, offset);
    greatest = std::max(greatest, offset);
  }
  EXPECT_GE(least, -0.015);
  EXPECT_LE(greatest, 0.015);
  EXPECT_GT(greatest - least, 0.027);  // all 200 in nine tenths: a chance of 1 in 10⁷
}

TEST(LaserModel, ReadingsAreWholeUnits) {
  const World world = box_tunnel();
  const RayScene scene(world.mesh);
  for (const double unit : {0.001, 0.01}) {
    LaserParams params;
    params.unit_m = unit;
    LaserModel laser(scene, params, 1);
    for (const float range : scan_at_rest(laser, laser_at(kMiddle)).ranges_m) {
      const double units = range / unit;
      EXPECT_NEAR(units, std::round(units), 8191.0 * 1e-7);  // single precision
      EXPECT_LE(std::round(units), 8191.0);
    }
  }
}

TEST(LaserModel, NoReturnIsTheLargestReading) {
  const TriangleMesh nothing;
  const RayScene scene(nothing);
  LaserModel laser(scene, {}, 1);
  EXPECT_THAT(scan_at_rest(laser, laser_at(kMiddle)).ranges_m, testing::Each(81.91F));
}

TEST(LaserModel, RangesBelowTheMinimumDoNotReturn) {
  const World world = box_tunnel({40.0, 0.3, 2.0});
  const RayScene scene(world.mesh);
  LaserModel laser(scene, perfect_laser(), 1);
  const LaserScan scan = scan_at_rest(laser, laser_at(kMiddle));
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double range = range_in_rectangle(40.0, 0.3, beam_angle(scan, i));
    const bool merge = range >= 0.2 && range < 8.191;
    EXPECT_NEAR(scan.ranges_m[i], merge ? range : 8.191, kHalfMillimetre) << i;
  }
}

TEST(LaserModel, MaximumRangeDependsOnReflectivityAndIncidence) {
  const World world = box_tunnel({400.0, 6.0, 2.0});
  const RayScene scene(world.mesh);
  for (const int subrays : {1, 9}) {
    LaserParams params = perfect_laser();
    params.unit_m = 0.01;
    params.range_at_10_percent_m = 5.0;
    params.subrays = subrays;
    LaserModel laser(scene, params, 1);
    const LaserScan scan = scan_at_rest(laser, laser_at(kMiddle));
    int merge = 0;
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      const double cosine = std::abs(std::sin(beam_angle(scan, i)));  // onto a wall along x
      const double range = 3.0 / cosine;
      const double power_share =
          reflectivity(Material::kRock) / 0.1 * cosine * 25.0 / range / range;
      if (std::abs(power_share - 1.0) < 0.01) continue;  // effect of the width of the beam
      EXPECT_EQ(scan.ranges_m[i]<81.9F, power_share> 1.0) << i;
      merge += power_share > 1.0 ? 1 : 0;
    }
    EXPECT_GT(merge, 100);
    EXPECT_LT(merge, 300);
  }
}

TEST(LaserModel, WaterGivesNoReturn) {
  const World world = box_tunnel({40.0, 40.0, 2.0}, [](MeshBuilder& builder) {
    builder.begin_part(PartKind::kWater, Material::kWater, "water");
    builder.box(level_box({0.0, 0.0, 0.1}, {20.0, 20.0, 0.1}));
  });
  const RayScene scene(world.mesh);
  for (const int subrays : {1, 9}) {
    LaserParams params = perfect_laser();
    params.subrays = subrays;
    LaserModel laser(scene, params, 1);
    const LaserScan scan = scan_at_rest(laser, laser_at(kMiddle, 0.0, 0.5));
    EXPECT_FLOAT_EQ(scan.ranges_m[180], 8.191F);
    // The laser is 1 − 0.15 = 0.85 m above the water, which the beams hit at 3.5 m.
    EXPECT_FLOAT_EQ(scan.ranges_m[90], 8.191F);
  }
}

TEST(LaserModel, NoiseOfABeamDoesNotDependOnOtherBeams) {
  const auto scan_of = [](const World& world, std::uint64_t seed) {
    const RayScene scene(world.mesh);
    LaserModel laser(scene, {}, seed);
    scan_at_rest(laser, laser_at(kMiddle));
    return scan_at_rest(laser, laser_at(kMiddle)).ranges_m;
  };
  const World empty = box_tunnel();
  const World with_post = box_tunnel({}, [](MeshBuilder& builder) {
    builder.begin_part(PartKind::kPost, Material::kTimber, "post");
    builder.box(level_box({3.0, 0.0, 1.0}, {0.2, 0.2, 2.0}));
  });
  const auto before = scan_of(empty, 1);
  const auto after = scan_of(with_post, 1);
  for (std::size_t i = 0; i < before.size(); ++i) {
    const bool on_post = std::abs(static_cast<double>(i) - 180.0) < 4.0;  // 1.97° to either side
    EXPECT_EQ(before[i] == after[i], !on_post) << i;
  }
  EXPECT_EQ(before, scan_of(empty, 1));
  EXPECT_NE(before, scan_of(empty, 2));
}

TEST(LaserModel, RejectsOtherNumbersOfSubRays) {
  const TriangleMesh nothing;
  const RayScene scene(nothing);
  LaserParams params;
  params.subrays = 4;
  EXPECT_THROW(LaserModel(scene, params, 1), std::invalid_argument);
}

}  // namespace
}  // namespace adit
