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
///      (tilt_t), WHEEL_ODOMETRY (wheel_odometry_t), IMU (imu_t), GAS (gas_t), SINKAGE (sinkage_t),
///      VEHICLE_STATE (vehicle_state_t); beside them TRUTH (pose_t in world), RUN_STATE
///      (run_state_t) and SIM_TIME (sim_time_t), each kTimePeriodUs.
class SimNode {
 public:
  using Params = SimulationParams;

  static constexpr std::int64_t kTimePeriodUs = 50'000;

  /// `bus` and `site` must outlive this. Throws as Simulation does.
  SimNode(Bus& bus, const Site& site, const Params& params, std::uint64_t seed,
          std::int64_t start_utime);

  /// Lets time go on by Simulation::kStepUs and publishes what was measured in that. A bus whose
  /// time is to be that of the simulation must have come there before: `next_utime()`.
  void step();

  /// Says what time it is, again: for a stage that came late or lost it.
  void publish_time();

  [[nodiscard]] std::int64_t next_utime() const {
    return simulation_.utime() + Simulation::kStepUs;
  }
  [[nodiscard]] const Simulation& simulation() const { return simulation_; }

  /// At fault when the run has failed.
  [[nodiscard]] Health health() const;

 private:
  void subscribe_commands();

  Bus& bus_;
  Simulation simulation_;
  std::int64_t time_utime_;  // of the newest SIM_TIME
};

}  // namespace adit
