// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Reproducibility and independence of random streams.
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/simulation/random_stream.hpp"
#include "tests/unit/sim/simulation/simulation_fixture.hpp"

namespace adit {
namespace {

template <class T>
std::vector<std::string> bytes_of_only(const std::vector<Reading>& readings) {
  std::vector<std::string> bytes;
  for (const T& one : only<T>(readings)) bytes.push_back(bytes_of(Reading(one)));
  return bytes;
}

const Commander kRoundTrip = drive(10.0, 0.5, 0.02);

TEST(Simulation, SameSeedAndCommandsGiveTheSameBytes) {
  const Site site(box_tunnel());
  const Site same(box_tunnel());
  for (const int subrays : {1, 9}) {
    SimulationParams params;
    params.laser.subrays = subrays;
    params.laser.scan_loss = 0.05;
    params.faults = {{"packet_loss", 5.0, "", 0.1}, {"time_jump", 8.0, "", -3.0}};
    const auto once = bytes_of(run(site, params, 20.0, kRoundTrip));
    const auto again = bytes_of(run(same, params, 20.0, kRoundTrip));
    EXPECT_GT(once.size(), 5000U);
    EXPECT_TRUE(once == again);
  }
}

TEST(Simulation, AnotherSeedChangesAllNoise) {
  const Site site(box_tunnel());
  const auto one = run(site, {}, 5.0, kRoundTrip, 1);
  const auto other = run(site, {}, 5.0, kRoundTrip, 2);
  EXPECT_NE(bytes_of_only<LaserReading>(one), bytes_of_only<LaserReading>(other));
  EXPECT_NE(bytes_of_only<ImuReading>(one), bytes_of_only<ImuReading>(other));
  EXPECT_NE(bytes_of_only<WheelOdometry>(one), bytes_of_only<WheelOdometry>(other));
  EXPECT_NE(bytes_of_only<BodyMotion>(one), bytes_of_only<BodyMotion>(other));
}

TEST(Simulation, SensorsHaveIndependentRandomStreams) {
  const Site site(box_tunnel());
  SimulationParams params;
  const auto one = run(site, params, 5.0, kRoundTrip);
  params.laser.scan_loss = 0.5;
  params.laser.noise_sd_m = 0.02;
  const auto other = run(site, params, 5.0, kRoundTrip);
  EXPECT_NE(bytes_of_only<LaserReading>(one), bytes_of_only<LaserReading>(other));
  EXPECT_EQ(bytes_of_only<ImuReading>(one), bytes_of_only<ImuReading>(other));
  EXPECT_EQ(bytes_of_only<WheelOdometry>(one), bytes_of_only<WheelOdometry>(other));
  EXPECT_EQ(bytes_of_only<BodyMotion>(one), bytes_of_only<BodyMotion>(other));
}

TEST(RandomStream, SeedsDifferForEachStreamAndSeed) {
  std::set<std::uint64_t> seeds;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    for (std::uint64_t stream = 0; stream <= 7; ++stream) {
      seeds.insert(stream_seed(seed, static_cast<RandomStream>(stream)));
    }
  }
  EXPECT_EQ(seeds.size(), 8000U);
}

}  // namespace
}  // namespace adit
