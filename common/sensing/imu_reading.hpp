// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace adit {

/// One reading of an inertial unit, in the body frame (x forward, y left, z up).
struct ImuReading {
  std::int64_t utime = 0;                                         ///< [µs since the epoch]
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();     ///< [rad/s]
  Eigen::Vector3d linear_acceleration = Eigen::Vector3d::Zero();  ///< specific force [m/s²]
};

}  // namespace adit
