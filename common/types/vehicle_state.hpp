// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace adit {

/// Commanded motion of the vehicle. Expires after 250 ms: the vehicle then stops.
struct DriveCommand {
  std::int64_t utime = 0;      ///< time of the command [µs since the epoch]
  double speed_m_s = 0.0;      ///< of the body's origin along its x axis; negative is reverse
  double curvature_1_m = 0.0;  ///< of the path of the body's origin, positive to the left of x

  friend bool operator==(const DriveCommand&, const DriveCommand&) = default;
};

/// Overriding stop: while stopped, the vehicle ignores drive commands.
struct StopOrder {
  std::int64_t utime = 0;  ///< [µs since the epoch]
  bool stopped = false;
  std::string reason;  ///< for the operator; empty unless stopped

  friend bool operator==(const StopOrder&, const StopOrder&) = default;
};

/// State reported by the vehicle.
struct VehicleState {
  std::int64_t utime = 0;      ///< [µs since the epoch]
  double speed_m_s = 0.0;      ///< from the wheels, along the body's x axis
  double curvature_1_m = 0.0;  ///< from the steering
  double battery_share = 1.0;  ///< of a full charge, 0 to 1
  bool stopped = false;        ///< held by a stop order, or because stop orders have timed out
  bool expired = false;  ///< held because the last drive command has expired or none was received

  friend bool operator==(const VehicleState&, const VehicleState&) = default;
};

/// State of a simulated run.
struct RunState {
  std::int64_t utime = 0;  ///< [µs since the epoch]
  double distance_travelled_m = 0.0;
  std::string failure;  ///< why the run has ended; empty while it continues

  friend bool operator==(const RunState&, const RunState&) = default;
};

}  // namespace adit
