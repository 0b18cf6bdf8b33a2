// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/sensing/ground_and_air.hpp"
#include "common/sensing/imu_reading.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/sensing/tilt_command.hpp"
#include "common/sensing/tilt_reading.hpp"
#include "common/sensing/wheel_odometry.hpp"
#include "common/vehicle/drive_command.hpp"
#include "common/vehicle/run_state.hpp"
#include "sim/simulation/simulation_params.hpp"
#include "sim/vehicle/vehicle_model.hpp"
#include "sim/world/world.hpp"

namespace adit {

enum class SimLaser { kFront, kRear };

struct LaserReading {
  SimLaser laser;
  LaserScan scan;
};

struct TiltOf {
  SimLaser laser;
  TiltReading reading;
};

/// What one driver delivers at one moment, or the simulator says beside them (BodyMotion: the
/// truth; RunState).
using Reading = std::variant<LaserReading, TiltOf, WheelOdometry, ImuReading, GasReading,
                             SinkageReading, VehicleState, BodyMotion, RunState>;

/// A robot in a mine, without transport and clock: commands in, readings out. The same site,
/// parameters, seed and commands give the same readings, bit for bit.
class Simulation {
 public:
  static constexpr std::int64_t kStepUs = 10'000;

  /// `site` must outlive this. Throws std::invalid_argument where the robot cannot stand at the
  /// start.
  Simulation(const Site& site, const SimulationParams& params, std::uint64_t seed,
             std::int64_t start_utime);

  void command(const DriveCommand& command);
  void command(const StopOrder& order);
  void command(SimLaser laser, const TiltCommand& command);

  /// Lets time go on by kStepUs and returns what the drivers deliver in that time, in the order in
  /// which they do: a scan when its last beam is measured.
  std::vector<Reading> step();

  [[nodiscard]] std::int64_t utime() const;  ///< true time, which no fault moves
  [[nodiscard]] const VehicleModel& vehicle() const;
  [[nodiscard]] RunState state() const;

 private:
  class Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace adit
