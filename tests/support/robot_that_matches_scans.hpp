// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "common/bus/memory_bus.hpp"
#include "procs/scan_matching/scan_matching_node.hpp"
#include "sim/sim_node.hpp"
#include "sim/world/world.hpp"

namespace adit {

/// A simulated robot on a bus in memory that finds its place as on a mission: by scan matching. It
/// starts at the origin of world, so that odom is world but for what scan matching gets wrong.
class RobotThatMatchesScans {
 public:
  static constexpr std::int64_t kStartUtime = 1'600'000'000'000'000;

  explicit RobotThatMatchesScans(World world);

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
