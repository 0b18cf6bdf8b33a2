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

/// Simulates the robot in a mine, independent of transport and clock: commands in, readings out.
/// The same site, parameters, seed and commands give the same readings, bit for bit. After a
/// failure of the run the vehicle stands and the sensors continue.
class Simulation {
 public:
  static constexpr std::int64_t kStepUs = 10'000;

  /// `site` must outlive this. Throws std::invalid_argument if the vehicle cannot stand at the
  /// start, for an invalid fault, for a mount whose range_max_m would accept the laser's reading
  /// for no return, and for a spinning lidar beside a second laser.
  Simulation(const Site& site, const SimulationParams& params, std::uint64_t seed,
             std::int64_t start_utime);
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  void command(const DriveCommand& command);
  void command(const StopOrder& order);
  void command(SimLaser laser, const TiltCommand& command);

  /// Advances time by kStepUs and returns the readings of the step in the order of delivery: a scan
  /// at the time of its last beam, all others at the end of the step. Order at the same time:
  /// scans, tilts, wheel odometry, IMU, gas, sinkage, vehicle, truth, run. Lasers scan
  /// continuously, the rear one half a period behind the front one. With a spinning lidar the front
  /// scans are its level view, after its revolutions, and there are no tilts.
  std::vector<Reading> step();

  [[nodiscard]] std::int64_t utime() const;  ///< true time, not affected by clock faults
  [[nodiscard]] const VehicleModel& vehicle() const;
  [[nodiscard]] RunState state() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace adit
