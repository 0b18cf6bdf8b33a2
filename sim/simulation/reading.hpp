// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <type_traits>
#include <variant>

#include "common/sensing/laser_scan.hpp"
#include "common/sensing/laser_tilt.hpp"
#include "common/sensing/spinning_lidar.hpp"
#include "common/sensing/vehicle_readings.hpp"
#include "common/types/vehicle_state.hpp"
#include "sim/vehicle/vehicle_model.hpp"

namespace adit {

enum class SimLaser { kFront, kRear };

struct LaserReading {
  SimLaser laser;
  LaserScan scan;
};

struct LaserTiltReading {
  SimLaser laser;
  TiltReading reading;
};

/// One output of a driver, or of the simulator itself (BodyMotion: the true pose; RunState).
using Reading =
    std::variant<LaserReading, LidarRevolution, LaserTiltReading, WheelOdometry, ImuReading,
                 GasReading, SinkageReading, VehicleState, BodyMotion, RunState>;

/// Time of measurement, by the clock of the sensor [µs since the epoch].
inline std::int64_t& utime_of(Reading& reading) {
  return std::visit(
      [](auto& value) -> std::int64_t& {
        using Value = std::remove_reference_t<decltype(value)>;
        if constexpr (std::is_same_v<Value, LaserReading>) {
          return value.scan.utime;
        } else if constexpr (std::is_same_v<Value, LaserTiltReading>) {
          return value.reading.utime;
        } else {
          return value.utime;
        }
      },
      reading);
}

/// Whether a driver publishes it, not the simulator itself.
inline bool is_driver_reading(const Reading& reading) {
  return !std::holds_alternative<BodyMotion>(reading) && !std::holds_alternative<RunState>(reading);
}

}  // namespace adit
