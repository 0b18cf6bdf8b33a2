// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/sensing/laser_tilt.hpp"
#include "common/types/vehicle_state.hpp"
#include "sim/simulation/reading.hpp"
#include "sim/simulation/simulation_params.hpp"
#include "sim/vehicle/vehicle_model.hpp"
#include "sim/world/world.hpp"

namespace adit {

/// A robot in a mine, without transport and clock: commands in, readings out. The same site,
/// parameters, seed and commands give the same readings, bit for bit. When the run has failed the
/// vehicle stands and the sensors go on.
class Simulation {
 public:
  static constexpr std::int64_t kStepUs = 10'000;

  /// `site` must outlive this. Throws std::invalid_argument where the robot cannot stand at the
  /// start, for a fault that makes no sense, and where a mount would believe in what its laser says
  /// for no return.
  Simulation(const Site& site, const SimulationParams& params, std::uint64_t seed,
             std::int64_t start_utime);
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  void command(const DriveCommand& command);
  void command(const StopOrder& order);
  void command(SimLaser laser, const TiltCommand& command);

  /// Lets time go on by kStepUs and returns what the drivers deliver in that time, in the order in
  /// which they do: a scan when its last beam is measured, all else at the end of a step. At the
  /// same moment: scans, tilts, wheels, inertia, gas, sinkage, vehicle, truth, run. Lasers scan
  /// without a break, the rear one half a period behind the front one.
  std::vector<Reading> step();

  [[nodiscard]] std::int64_t utime() const;  ///< true time, which no fault moves
  [[nodiscard]] const VehicleModel& vehicle() const;
  [[nodiscard]] RunState state() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace adit
