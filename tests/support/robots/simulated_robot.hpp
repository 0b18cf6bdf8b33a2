// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "common/bus/memory_bus.hpp"
#include "procs/scan_matching/scan_matching_node.hpp"
#include "sim/sim_node.hpp"
#include "sim/simulation/simulation_params.hpp"
#include "sim/world/world.hpp"

namespace adit {

/// Default parameters of a stage, with the laser mounts of the simulated robot.
template <class Params>
Params with_groundhog_lasers() {
  Params params;
  params.lasers = groundhog_lasers();
  return params;
}

/// A simulated robot on an in-memory bus with perfect localization: the simulator's TRUTH is
/// published as POSE in place of scan matching, so that odom equals world.
class GroundTruthRobot {
 public:
  static constexpr std::int64_t kStartUtime = 1'600'000'000'000'000;

  explicit GroundTruthRobot(World world, const SimulationParams& params = {});

  /// Runs for a simulated time.
  void run(double seconds);

  /// Stops publishing POSE.
  void stop_localization() { localized_ = false; }

  [[nodiscard]] MemoryBus& bus() { return bus_; }
  [[nodiscard]] const Simulation& simulation() const { return sim_.simulation(); }

 private:
  Site site_;
  MemoryBus bus_;
  SimNode sim_;
  std::vector<std::uint8_t> truth_;
  bool localized_ = true;
};

/// A simulated robot on an in-memory bus that is localized by scan matching. It starts at the
/// origin of world, so that odom equals world up to the error of scan matching.
class ScanMatchingRobot {
 public:
  static constexpr std::int64_t kStartUtime = 1'600'000'000'000'000;

  explicit ScanMatchingRobot(World world);

  /// Runs for a simulated time.
  void run(double seconds);

  [[nodiscard]] MemoryBus& bus() { return bus_; }
  [[nodiscard]] const Site& site() const { return site_; }
  [[nodiscard]] const Simulation& simulation() const { return sim_.simulation(); }

 private:
  Site site_;
  MemoryBus bus_;
  SimNode sim_{bus_, site_, SimulationParams{}, 1, kStartUtime};
  ScanMatchingNode scan_matching_;
};

}  // namespace adit
