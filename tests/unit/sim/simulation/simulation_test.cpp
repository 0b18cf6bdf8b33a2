// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/simulation/simulation.hpp"

#include <algorithm>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/sim/simulation/simulation_fixture.hpp"

namespace adit {
namespace {

SimulationParams perfect_lasers() {
  SimulationParams params;
  params.laser.unit_m = 0.001;
  params.laser.noise_sd_m = 0.0;
  params.laser.offset_max_m = 0.0;
  params.laser.range_at_10_percent_m = 1000.0;
  params.lasers.front.range_max_m = 8.0;
  params.lasers.rear.range_max_m = 8.0;
  return params;
}

TEST(Simulation, DeliversEachReadingAtItsRate) {
  const Site site(box_tunnel());
  const auto readings = run(site, {}, 10.0);
  // The last beam comes 19.98 ms after the first; 10 s hold so many times 26.67 ms before that.
  EXPECT_EQ(scans_of(readings, SimLaser::kFront).size(), 375U);
  EXPECT_EQ(scans_of(readings, SimLaser::kRear).size(), 374U);
  EXPECT_EQ(only<LaserTiltReading>(readings).size(), 2U * 500U);
  EXPECT_EQ(only<WheelOdometry>(readings).size(), 200U);
  EXPECT_EQ(only<ImuReading>(readings).size(), 1000U);
  EXPECT_EQ(only<GasReading>(readings).size(), 20U);
  EXPECT_EQ(only<SinkageReading>(readings).size(), 100U);
  EXPECT_EQ(only<VehicleState>(readings).size(), 100U);
  EXPECT_EQ(only<BodyMotion>(readings).size(), 500U);
  EXPECT_EQ(only<RunState>(readings).size(), 10U);
}

TEST(Simulation, LasersOfOneDegreeScanTwiceAsOften) {
  const Site site(box_tunnel());
  SimulationParams params;
  params.laser.beams = 181;
  const auto scans = scans_of(run(site, params, 2.0), SimLaser::kFront);
  EXPECT_EQ(scans.size(), 150U);
  EXPECT_EQ(scans.front().ranges_m.size(), 181U);
}

TEST(Simulation, ANoiseSeedReplacesThatOfTheWorldForErrorsOfSensors) {
  const Site site(box_tunnel());
  SimulationParams params;
  const auto by_world = bytes_of(run(site, params, 1.0, stand, 7));
  params.noise_seed = 7;
  EXPECT_EQ(bytes_of(run(site, params, 1.0, stand, 1)), by_world);
  params.noise_seed = 8;
  EXPECT_NE(bytes_of(run(site, params, 1.0, stand, 7)), by_world);
}

TEST(Simulation, ARobotWithOneLaserHasNoReadingsOfARearOne) {
  const Site site(box_tunnel());
  SimulationParams params;
  params.lasers.count = 1;
  params.lasers.front.field_of_view_rad = 1.5 * std::numbers::pi;
  params.lasers.front.timing = {.mirror_hz = 40.0, .mirror_turns = 1};
  params.laser.beams = 1081;
  const auto readings = run(site, params, 2.0);
  EXPECT_EQ(scans_of(readings, SimLaser::kFront).size(), 80U);  // the last one ends at 1.99 s
  EXPECT_EQ(scans_of(readings, SimLaser::kFront).front().ranges_m.size(), 1081U);
  EXPECT_THAT(scans_of(readings, SimLaser::kRear), testing::IsEmpty());
  EXPECT_EQ(only<LaserTiltReading>(readings).size(), 100U);
}

TEST(Simulation, OmitsAbsentSensorsAndDecimatedScans) {
  const Site site(box_tunnel());
  SimulationParams params;
  params.imu.present = false;
  params.wheel_odometry.present = false;
  params.laser.scan_decimation = 5;
  const auto readings = run(site, params, 10.0);
  EXPECT_THAT(only<ImuReading>(readings), testing::IsEmpty());
  EXPECT_THAT(only<WheelOdometry>(readings), testing::IsEmpty());
  const auto scans = scans_of(readings, SimLaser::kFront);
  EXPECT_EQ(scans.size(), 75U);
  EXPECT_NEAR(static_cast<double>(scans[2].utime - scans[1].utime), 5.0 / 37.5 * 1e6, 1.0);
}

TEST(Simulation, ScansAreDeliveredAtTheirLastBeam) {
  const Site site(box_tunnel());
  Simulation simulation(site, {}, 1, kStart);
  const double last_beam_us = (1.0 + 179.5 / 360.0) / 75.0 * 1e6;
  for (int step = 0; step < 300; ++step) {
    const std::int64_t before = simulation.utime();
    std::int64_t newest = before;
    bool others = false;
    for (const Reading& reading : simulation.step()) {
      const auto* laser = std::get_if<LaserReading>(&reading);
      others = others || laser == nullptr;
      if (laser == nullptr) continue;
      EXPECT_FALSE(others) << "all else is measured at the end of the step";
      const std::int64_t end = laser->scan.utime + static_cast<std::int64_t>(last_beam_us) + 1;
      EXPECT_GE(end, newest);
      EXPECT_LE(end, simulation.utime());
      newest = end;
    }
  }
}

TEST(Simulation, TheRearLaserIsHalfAPeriodBehind) {
  const Site site(box_tunnel());
  const auto readings = run(site, {}, 1.0);
  const auto front = scans_of(readings, SimLaser::kFront);
  const auto rear = scans_of(readings, SimLaser::kRear);
  EXPECT_EQ(front[0].utime, kStart);
  for (std::size_t i = 0; i < rear.size(); ++i) {
    EXPECT_NEAR(static_cast<double>(rear[i].utime - front[i].utime), 0.5 / 37.5 * 1e6, 1.0);
  }
}

/// Interpolates between the published true poses.
Eigen::Vector3d position_at(const std::vector<BodyMotion>& truth, double utime) {
  const auto after = std::find_if(truth.begin(), truth.end(), [&](const BodyMotion& motion) {
    return static_cast<double>(motion.utime) >= utime;
  });
  const BodyMotion& a = *std::prev(after);
  const double share =
      (utime - static_cast<double>(a.utime)) / static_cast<double>(after->utime - a.utime);
  return (1.0 - share) * a.T_world_body.translation() + share * after->T_world_body.translation();
}

TEST(Simulation, BeamsStartAtThePoseOfTheBodyAtTheirTime) {
  const Site site(box_tunnel({16.0, 4.0, 2.0}));
  const auto readings = run(site, perfect_lasers(), 5.0, [](Simulation& simulation, double) {
    simulation.command(DriveCommand{simulation.utime(), 0.5, 0.0});
  });
  const auto truth = only<BodyMotion>(readings);
  ASSERT_GT(truth.back().T_world_body.translation().x(), 1.5);
  int checked = 0;
  for (const LaserScan& scan : scans_of(readings, SimLaser::kFront)) {
    const double utime = static_cast<double>(scan.utime) + 0.25 / 75.0 * 1e6;  // the middle beam
    if (utime < static_cast<double>(truth.front().utime)) continue;
    // Half a unit, and what 20 ms at 0.8 m/s² put between truth and a straight line.
    const double tolerance = 0.0005 + 0.8 * 0.02 * 0.02 / 8.0 + 0.0003;
    const double range = 8.0 - position_at(truth, utime).x() - 1.05;
    EXPECT_NEAR(scan.ranges_m[180], range, tolerance) << scan.utime - kStart;
    ++checked;
  }
  EXPECT_GT(checked, 180);
}

TEST(Simulation, TiltedLasersMeasureTheFloorAtTheirEncoderAngle) {
  const Site site(box_tunnel());
  Simulation simulation(site, perfect_lasers(), 1, kStart);
  for (const SimLaser laser : {SimLaser::kFront, SimLaser::kRear}) {
    simulation.command(laser, TiltCommand{kStart, 0.3, 0.5});
  }
  run(simulation, 1.0);
  const auto readings = run(simulation, 0.1);
  const double height = 0.62 - 0.08 + 0.08 * std::cos(0.3) - 0.06 * std::sin(0.3);
  const double body = simulation.vehicle().motion().T_world_body.translation().z();
  for (const LaserTiltReading& tilt : only<LaserTiltReading>(readings)) {
    EXPECT_NEAR(tilt.reading.angle_rad, 0.3, 0.0001);
  }
  for (const LaserReading& laser : only<LaserReading>(readings)) {
    EXPECT_NEAR(laser.scan.ranges_m[180], (height + body) / std::sin(0.3), 0.001);
  }
}

TEST(Simulation, GasFallsOffAsANormalDistribution) {
  World world = box_tunnel();
  world.gas = {{"pocket", {3.0, 4.0}, 5.0, 0.04}};
  const Site site(std::move(world));
  const auto readings = run(site, {}, 1.0);
  const double share = 0.04 * std::exp(-0.5);  // one standard deviation away
  EXPECT_NEAR(only<GasReading>(readings)[0].methane_share, share, 1e-9);
  EXPECT_NEAR(only<GasReading>(readings)[0].oxygen_share, 0.209 * (1.0 - share), 1e-9);
}

TEST(Simulation, AFailureIsReportedImmediatelyAndSensorsContinue) {
  const Site site(box_tunnel({8.0, 4.0, 2.0}));
  Simulation simulation(site, {}, 1, kStart);
  std::vector<RunState> failed;
  for (int step = 0; step < 1500; ++step) {
    drive()(simulation, 0.0);
    const auto readings = simulation.step();
    for (const RunState& state : only<RunState>(readings)) {
      if (!state.failure.empty()) failed.push_back(state);
    }
    if (!simulation.state().failure.empty()) break;
  }
  ASSERT_EQ(failed.size(), 1U);
  EXPECT_EQ(failed[0], simulation.state());
  EXPECT_NEAR(failed[0].distance_travelled_m, 4.0 - 1.2,
              0.1);  // from the middle to where the front is met

  const Eigen::Vector3d there = simulation.vehicle().motion().T_world_body.translation();
  const auto after = run(simulation, 2.0, drive());
  EXPECT_GT(only<LaserReading>(after).size(), 140U);
  EXPECT_EQ(only<ImuReading>(after).size(), 200U);
  EXPECT_EQ(simulation.vehicle().motion().T_world_body.translation(), there);
}

TEST(Simulation, RejectsAMountThatAcceptsTheNoReturnReading) {
  const Site site(box_tunnel());
  SimulationParams params;
  params.laser.unit_m = 0.001;
  EXPECT_THROW(Simulation(site, params, 1, kStart), std::invalid_argument);
}

TEST(Simulation, GroundhogHasALaserAtEachEnd) {
  const Lasers lasers = groundhog_lasers();
  EXPECT_EQ(lasers.front.T_body_laser, (Pose2{1.05, 0.0, 0.0}));
  EXPECT_EQ(lasers.rear.T_body_laser, (Pose2{-1.05, 0.0, std::numbers::pi}));
  EXPECT_LT(lasers.front.range_max_m, LaserParams{}.no_return_m());
}

}  // namespace
}  // namespace adit
