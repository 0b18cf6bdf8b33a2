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

/// The parameters of a stage that is told of lasers, with those of the simulated robot.
template <class Params>
Params with_groundhog_lasers() {
  Params params;
  params.lasers = groundhog_lasers();
  return params;
}

/// A simulated robot on a bus in memory, for stages that need to know where they are: the
/// simulator's TRUTH goes out as POSE in place of scan matching, so that odom is world.
class GroundTruthRobot {
 public:
  static constexpr std::int64_t kStartUtime = 1'600'000'000'000'000;

  explicit GroundTruthRobot(World world, const SimulationParams& params = {});

  /// Of simulated time.
  void run(double seconds);

  /// No POSE from now on.
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

/// A simulated robot on a bus in memory that finds its place as on a mission: by scan matching. It
/// starts at the origin of world, so that odom is world but for what scan matching gets wrong.
class ScanMatchingRobot {
 public:
  static constexpr std::int64_t kStartUtime = 1'600'000'000'000'000;

  explicit ScanMatchingRobot(World world);

  /// Of simulated time.
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
