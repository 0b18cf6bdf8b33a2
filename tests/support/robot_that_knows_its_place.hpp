// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "common/bus/memory_bus.hpp"
#include "sim/sim_node.hpp"
#include "sim/world/world.hpp"

namespace adit {

/// A simulated robot on a bus in memory, for stages that need to know where they are: the
/// simulator's TRUTH goes out as POSE in place of scan matching, so that odom is world.
class RobotThatKnowsItsPlace {
 public:
  static constexpr std::int64_t kStartUtime = 1'600'000'000'000'000;

  explicit RobotThatKnowsItsPlace(World world, const SimulationParams& params = {});

  /// Of simulated time.
  void run(double seconds);

  /// No POSE from now on.
  void lose_its_place() { knows_ = false; }

  [[nodiscard]] MemoryBus& bus() { return bus_; }
  [[nodiscard]] const Simulation& simulation() const { return sim_.simulation(); }

 private:
  Site site_;
  MemoryBus bus_;
  SimNode sim_;
  std::vector<std::uint8_t> truth_;
  bool knows_ = true;
};

}  // namespace adit
