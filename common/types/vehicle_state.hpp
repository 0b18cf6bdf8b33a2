// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace adit {

/// How the vehicle is to move from now on. Expires after 250 ms: the vehicle then stops.
struct DriveCommand {
  std::int64_t utime = 0;      ///< time of the command [µs since the epoch]
  double speed_m_s = 0.0;      ///< of the body's origin along its x axis; negative is reverse
  double curvature_1_m = 0.0;  ///< of the path of the body's origin, positive to the left of x

  friend bool operator==(const DriveCommand&, const DriveCommand&) = default;
};

/// The last word on motion: whether the vehicle is to stand, whatever else it is told.
struct StopOrder {
  std::int64_t utime = 0;  ///< [µs since the epoch]
  bool stopped = false;
  std::string reason;  ///< for people; empty unless stopped

  friend bool operator==(const StopOrder&, const StopOrder&) = default;
};

/// How the vehicle is, as it says itself.
struct VehicleState {
  std::int64_t utime = 0;      ///< [µs since the epoch]
  double speed_m_s = 0.0;      ///< by the wheels, along the body's x axis
  double curvature_1_m = 0.0;  ///< by the steering
  double battery_share = 1.0;  ///< of a full charge, 0 to 1
  bool stopped = false;        ///< held by a stop order, or because these no longer come
  bool expired = false;        ///< held because the last drive command is too old, or none came

  friend bool operator==(const VehicleState&, const VehicleState&) = default;
};

/// How a simulated run stands.
struct RunState {
  std::int64_t utime = 0;  ///< [µs since the epoch]
  double distance_travelled_m = 0.0;
  std::string failure;  ///< why the run is over; empty while it is not

  friend bool operator==(const RunState&, const RunState&) = default;
};

}  // namespace adit
