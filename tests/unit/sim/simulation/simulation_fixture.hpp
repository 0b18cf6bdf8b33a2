// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sim/simulation/simulation.hpp"
#include "tests/support/worlds/box_tunnel.hpp"

namespace adit {

constexpr std::int64_t kStart = 1'000'000'000'000;

/// Sends commands to a simulation before a step; `seconds` count from its start.
using Commander = std::function<void(Simulation&, double seconds)>;

inline void stand(Simulation&, double) {}

/// Straight ahead, in reverse after `turn_s`, with nodding lasers.
inline Commander drive(double turn_s = 1e9, double speed_m_s = 0.5, double curvature_1_m = 0.0) {
  return [=](Simulation& simulation, double seconds) {
    const std::int64_t utime = simulation.utime();
    if (utime % 100'000 != 0) return;
    const double speed = seconds < turn_s ? speed_m_s : -speed_m_s;
    simulation.command(DriveCommand{utime, speed, curvature_1_m});
    const double tilt = std::fmod(seconds, 4.0) < 2.0 ? 0.4 : -0.4;
    simulation.command(SimLaser::kFront, TiltCommand{utime, tilt, 0.4});
  };
}

/// All readings of the given time.
inline std::vector<Reading> run(Simulation& simulation, double seconds,
                                const Commander& command = stand) {
  std::vector<Reading> all;
  const std::int64_t begin = simulation.utime();
  while (simulation.utime() - begin < std::llround(seconds * 1e6)) {
    command(simulation, static_cast<double>(simulation.utime() - begin) * 1e-6);
    for (Reading& reading : simulation.step()) all.push_back(std::move(reading));
  }
  return all;
}

inline std::vector<Reading> run(const Site& site, const SimulationParams& params, double seconds,
                                const Commander& command = stand, std::uint64_t seed = 1) {
  Simulation simulation(site, params, seed, kStart);
  return run(simulation, seconds, command);
}

template <class T>
std::vector<T> only(const std::vector<Reading>& readings) {
  std::vector<T> found;
  for (const Reading& reading : readings) {
    if (const T* one = std::get_if<T>(&reading)) found.push_back(*one);
  }
  return found;
}

inline std::vector<LaserScan> scans_of(const std::vector<Reading>& readings, SimLaser laser) {
  std::vector<LaserScan> scans;
  for (const LaserReading& reading : only<LaserReading>(readings)) {
    if (reading.laser == laser) scans.push_back(reading.scan);
  }
  return scans;
}

/// Every bit of a reading.
std::string bytes_of(const Reading& reading);

inline std::vector<std::string> bytes_of(const std::vector<Reading>& readings) {
  std::vector<std::string> bytes;
  for (const Reading& reading : readings) bytes.push_back(bytes_of(reading));
  return bytes;
}

}  // namespace adit
