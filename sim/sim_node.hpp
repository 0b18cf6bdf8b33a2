// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "common/bus/bus.hpp"
#include "common/messages/diagnostics.hpp"
#include "sim/simulation/simulation.hpp"

namespace adit {

/// In:  DRIVE_COMMAND (drive_command_t), STOP (stop_t), TILT_COMMAND_FRONT, TILT_COMMAND_REAR
///      (tilt_command_t).
/// Out: what the drivers publish: LASER_FRONT, LASER_REAR (planar_lidar_t), TILT_FRONT, TILT_REAR
///      (tilt_t) or LIDAR (spinning_lidar_t), WHEEL_ODOMETRY (wheel_odometry_t), IMU (imu_t), GAS
///      (gas_t), SINKAGE (sinkage_t), VEHICLE_STATE (vehicle_state_t). Out, of the simulator: TRUTH
///      (pose_t in world), RUN_STATE (run_state_t) and SIM_TIME (sim_time_t), every kTimePeriodUs.
class SimNode {
 public:
  using Params = SimulationParams;

  static constexpr std::int64_t kTimePeriodUs = 50'000;

  /// `bus` and `site` must outlive this. Throws as Simulation does.
  SimNode(Bus& bus, const Site& site, const Params& params, std::uint64_t seed,
          std::int64_t start_utime);

  /// Advances the simulation by Simulation::kStepUs and publishes the readings of the step. A bus
  /// that follows simulated time must be advanced to `next_utime()` first.
  void step();

  /// Publishes the current SIM_TIME again, for stages that started late or lost it.
  void publish_time();

  [[nodiscard]] std::int64_t next_utime() const {
    return simulation_.utime() + Simulation::kStepUs;
  }
  [[nodiscard]] const Simulation& simulation() const { return simulation_; }

  /// Reports a fault when the run has failed.
  [[nodiscard]] Health health() const;

 private:
  void subscribe_commands();

  Bus& bus_;
  Simulation simulation_;
  std::int64_t time_utime_;  // of the latest SIM_TIME
};

}  // namespace adit
