// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/simulation/spinning_lidar.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/unit/sim/simulation/simulation_fixture.hpp"

namespace adit {
namespace {

const BoxTunnel kLidarTunnel;

SimulationParams with_lidar(double pitch_rad) {
  SimulationParams params;
  params.lasers.count = 1;
  params.lasers.front.T_body_laser = {0.2, 0.0, 0.0};
  params.lasers.front.height_m = 0.9;
  params.lasers.front.timing = {.mirror_hz = 20.0, .mirror_turns = 1};
  params.lasers.lidar = {true, pitch_rad, 900};
  params.laser.unit_m = 0.002;
  params.laser.reading_max = 65535;
  params.laser.noise_sd_m = 0.0;
  params.laser.offset_max_m = 0.0;
  params.laser.range_at_10_percent_m = 1000.0;
  return params;
}

double to_surface_m(const Eigen::Vector3d& p) {
  return std::min({std::abs(p.z()), std::abs(p.z() - kLidarTunnel.height_m),
                   std::abs(std::abs(p.y()) - kLidarTunnel.width_m / 2.0),
                   std::abs(std::abs(p.x()) - kLidarTunnel.length_m / 2.0)});
}

TEST(SimulatedSpinningLidar, PutsEveryReturnOnASurfaceWhileItDrives) {
  const Site site(box_tunnel(kLidarTunnel));
  const SimulationParams params = with_lidar(0.21);
  const auto readings = run(site, params, 2.0, drive(1e9, 0.5, 0.3));
  const auto revolutions = only<LidarRevolution>(readings);
  ASSERT_EQ(revolutions.size(), 10U);  // of 40 each fourth
  const auto truth = only<BodyMotion>(readings);
  double largest_m = 0.0;
  for (const LidarRevolution& revolution : revolutions) {
    for (std::size_t column = 0; column < revolution.columns.size(); column += 7) {
      const std::int64_t utime = revolution.utime_of(column, 0);
      const auto motion = std::ranges::min_element(
          truth, {}, [&](const BodyMotion& m) { return std::abs(m.utime - utime); });
      if (std::abs(motion->utime - utime) > 1000) continue;  // 0.5 mm at 0.5 m/s
      for (std::size_t ring = 0; ring < revolution.rings.size(); ++ring) {
        const double range_m = revolution.range_m(column, ring);
        ASSERT_TRUE(std::isfinite(range_m));
        const Eigen::Vector3d p_body =
            T_body_lidar(params.lasers) * (range_m * revolution.direction(column, ring));
        largest_m = std::max(largest_m, to_surface_m(motion->T_world_body * p_body));
      }
    }
  }
  EXPECT_GT(largest_m, 0.0);
  EXPECT_LT(largest_m, 0.01);  // 1 ms of turning by 0.15 rad/s at up to 20 m, and of 0.5 m/s
}

TEST(SimulatedSpinningLidar, IsAFrontLaserThatSeesAllAround) {
  const Site site(box_tunnel(kLidarTunnel));
  const auto readings = run(site, with_lidar(0.21), 2.0);
  const auto scans = scans_of(readings, SimLaser::kFront);
  EXPECT_EQ(scans.size(), 40U);
  EXPECT_TRUE(scans_of(readings, SimLaser::kRear).empty());
  EXPECT_TRUE(only<LaserTiltReading>(readings).empty());
  const LaserScan& scan = scans.back();
  const double left_m = kLidarTunnel.width_m / 2.0;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double bearing = scan.angle_min_rad + static_cast<double>(i) * scan.angle_step_rad;
    const double true_m = left_m / std::abs(std::sin(bearing));
    if (true_m > 6.0) continue;
    ASSERT_NEAR(scan.ranges_m[i], true_m, 0.01) << bearing;
  }
}

TEST(SimulatedSpinningLidar, IsRejectedBesideASecondLaser) {
  const Site site(box_tunnel(kLidarTunnel));
  SimulationParams params = with_lidar(0.0);
  params.lasers.count = 2;
  EXPECT_THROW(Simulation(site, params, 1, kStart), std::invalid_argument);
}

TEST(SimulatedSpinningLidar, DiesAsTheFrontLaser) {
  const Site site(box_tunnel(kLidarTunnel));
  SimulationParams params = with_lidar(0.0);
  params.faults = {{"laser_dies", 1.0, "front", 0.0}};
  const auto readings = run(site, params, 2.0);
  EXPECT_EQ(scans_of(readings, SimLaser::kFront).size(), 20U);
  EXPECT_EQ(only<LidarRevolution>(readings).size(), 5U);
}

}  // namespace
}  // namespace adit
