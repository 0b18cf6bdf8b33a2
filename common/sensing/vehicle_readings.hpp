// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"

namespace adit {

/// Pose of the body by dead reckoning of the wheels, in a frame with an arbitrary origin. Only the
/// motion between two readings is meaningful.
struct WheelOdometry {
  std::int64_t utime = 0;  ///< time of measurement [µs since the epoch]
  Pose2 T_wheel_body;
};

/// One IMU reading, in the body frame (x forward, y left, z up).
struct ImuReading {
  std::int64_t utime = 0;                                         ///< [µs since the epoch]
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();     ///< [rad/s]
  Eigen::Vector3d linear_acceleration = Eigen::Vector3d::Zero();  ///< specific force [m/s²]
};

/// Gas concentrations at the vehicle.
struct GasReading {
  std::int64_t utime = 0;              ///< [µs since the epoch]
  double methane_share = 0.0;          ///< of the volume, 0 to 1
  double oxygen_share = 0.209;         ///< of the volume, 0 to 1
  double carbon_monoxide_share = 0.0;  ///< of the volume, 0 to 1

  friend bool operator==(const GasReading&, const GasReading&) = default;
};

/// Sinkage of each wheel in the ground.
struct SinkageReading {
  std::int64_t utime = 0;           ///< [µs since the epoch]
  std::array<double, 4> depth_m{};  ///< front left, front right, rear left, rear right

  friend bool operator==(const SinkageReading&, const SinkageReading&) = default;
};

}  // namespace adit
