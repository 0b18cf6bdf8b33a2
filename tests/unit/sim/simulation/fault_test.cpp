// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/sim/simulation/simulation_fixture.hpp"

namespace adit {
namespace {

constexpr std::int64_t kSecond = 1'000'000;

SimulationParams with(std::vector<FaultDescription> faults) {
  SimulationParams params;
  params.faults = std::move(faults);
  return params;
}

TEST(Faults, ADeadLaserIsStaleUntilItRecovers) {
  const Site site(box_tunnel());
  const auto readings = run(
      site, with({{"laser_dies", 2.0, "front", 0.0}, {"laser_recovers", 4.0, "front", 0.0}}), 6.0);
  std::int64_t last_before = 0;
  std::int64_t first_after = 0;
  for (const LaserScan& scan : scans_of(readings, SimLaser::kFront)) {
    const std::int64_t since = scan.utime - kStart;
    if (since < 3 * kSecond) last_before = since;
    if (since > 3 * kSecond && first_after == 0) first_after = since;
  }
  EXPECT_LT(last_before, 2 * kSecond - 19'000);  // its last beam was still measured
  EXPECT_GT(last_before, 2 * kSecond - 50'000);
  EXPECT_GE(first_after, 4 * kSecond);
  EXPECT_LT(first_after, 4 * kSecond + 30'000);

  const auto healthy = run(site, {}, 6.0);
  EXPECT_EQ(scans_of(readings, SimLaser::kRear), scans_of(healthy, SimLaser::kRear));
}

TEST(Faults, ATimeJumpMovesTheClockOfTheSensorsOnly) {
  const Site site(box_tunnel());
  const auto healthy = run(site, {}, 4.0, drive());
  auto jumped =
      run(site, with({{"time_jump", 2.0, "", 5.0}, {"time_jump", 3.0, "", -7.0}}), 4.0, drive());
  ASSERT_EQ(jumped.size(), healthy.size());
  for (std::size_t i = 0; i < jumped.size(); ++i) {
    Reading right = healthy[i];
    const std::int64_t since = utime_of(right) - kStart;
    if (is_driver_reading(right)) {
      utime_of(right) += since >= 3 * kSecond   ? -2 * kSecond
                         : since >= 2 * kSecond ? 5 * kSecond
                                                : 0;
    }
    EXPECT_EQ(bytes_of(jumped[i]), bytes_of(right)) << since;
  }
}

/// Speed one second after a jump of the sensors' clock at 2 s, under a driver that uses that clock.
double speed_after_jump(double jump_s) {
  const Site site(box_tunnel());
  Simulation simulation(site, with({{"time_jump", 2.0, "", jump_s}}), 1, kStart);
  std::int64_t clock_utime = kStart;
  while (simulation.utime() < kStart + 3 * kSecond) {
    simulation.command(DriveCommand{clock_utime, 0.4, 0.0});
    for (const ImuReading& reading : only<ImuReading>(simulation.step())) {
      clock_utime = reading.utime;
    }
  }
  return simulation.vehicle().state().speed_m_s;
}

TEST(Faults, AVehicleStandsIfTheClockOfItsDriverJumpsBack) {
  EXPECT_EQ(speed_after_jump(-2.0), 0.0);  // expired after 0.25 s, then brakes for 0.5 s
}

TEST(Faults, AVehicleContinuesIfTheClockOfItsDriverIsAhead) {
  EXPECT_DOUBLE_EQ(speed_after_jump(5.0), 0.4);
}

TEST(Faults, PacketLossDropsItsFractionOfAllButTheTruth) {
  const Site site(box_tunnel());
  const auto all = bytes_of(run(site, {}, 20.0));
  const auto rest = run(site, with({{"packet_loss", 10.0, "", 0.3}}), 20.0);
  EXPECT_EQ(only<BodyMotion>(rest).size(), 1000U);
  EXPECT_EQ(only<RunState>(rest).size(), 20U);
  const double n = (static_cast<double>(all.size()) - 1020.0) / 2.0;  // that may be lost
  const double lost = static_cast<double>(all.size() - rest.size());
  EXPECT_NEAR(lost, 0.3 * n, 4.0 * std::sqrt(n * 0.3 * 0.7));  // four standard deviations
  // The remaining messages are unchanged.
  auto next = all.begin();
  for (const std::string& bytes : bytes_of(rest)) {
    next = std::find(next, all.end(), bytes);
    ASSERT_NE(next++, all.end());
  }
}

TEST(Faults, PacketLossOfNothingAndOfEverything) {
  const Site site(box_tunnel());
  const auto rest =
      run(site, with({{"packet_loss", 1.0, "", 1.0}, {"packet_loss", 2.0, "", 0.0}}), 3.0);
  const auto imu = only<ImuReading>(rest);
  EXPECT_EQ(imu.size(), 200U);
  for (const ImuReading& reading : imu) {
    const std::int64_t since = reading.utime - kStart;
    EXPECT_TRUE(since < kSecond || since >= 2 * kSecond) << since;
  }
}

TEST(Faults, LostScansAreTheConfiguredFraction) {
  const Site site(box_tunnel());
  SimulationParams params;
  params.laser.scan_loss = 0.2;
  const auto readings = run(site, params, 40.0);
  const double n = 2.0 * 1499.0;
  EXPECT_NEAR(static_cast<double>(only<LaserReading>(readings).size()), 0.8 * n,
              4.0 * std::sqrt(n * 0.2 * 0.8));  // four standard deviations
}

TEST(Faults, OfProcessesAreIgnored) {
  const Site site(box_tunnel());
  const auto readings =
      run(site, with({{"kill", 0.5, "mapping", 0.0}, {"suspend", 0.6, "mapping", 0.0}}), 1.0);
  EXPECT_EQ(bytes_of(readings), bytes_of(run(site, {}, 1.0)));
}

TEST(Faults, ThatAreInvalidAreRejected) {
  const Site site(box_tunnel());
  EXPECT_THROW(run(site, with({{"laser_dies", 1.0, "left", 0.0}}), 0.1), std::invalid_argument);
  EXPECT_THROW(run(site, with({{"packet_loss", 1.0, "", 1.5}}), 0.1), std::invalid_argument);
}

}  // namespace
}  // namespace adit
