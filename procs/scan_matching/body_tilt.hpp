// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/sensing/vehicle_readings.hpp"

namespace adit {

struct BodyTiltParams {
  double time_constant_s = 2.0;  ///< time after which the accelerometer outweighs the gyro
  /// Of the specific force from 9.81; beyond, it is not gravity alone.
  double deviation_max_m_s2 = 0.5;
  double ground_m = 10.0;   ///< path length over which the mean tilt is taken as that of the ground
  double rise_max_m = 0.4;  ///< maximum change of a beam's height above the ground

  template <class V>
  void visit(V& v) {
    v("time_constant_s", time_constant_s, above(0.0));
    v("deviation_max_m_s2", deviation_max_m_s2, above(0.0));
    v("ground_m", ground_m, above(0.0));
    v("rise_max_m", rise_max_m, above(0.0));
  }
};

/// Estimates the tilt of the body relative to the ground, from gyro and accelerometer. With a wheel
/// in mud or on a rail, a level laser observes the floor ahead or behind, or the roof. These points
/// move with the body, like a wall that reports no motion.
class BodyTilt {
 public:
  explicit BodyTilt(const BodyTiltParams& params) : params_(params) {}

  /// Ignores readings that do not advance in time or are not finite.
  void add(const ImuReading& reading);
  /// Reports the distance driven since the last call.
  void drive(double distance_m);

  /// Whether a beam of a level laser that ends at `p_body` is near the laser's height above the
  /// ground there. True while the tilt is unknown.
  [[nodiscard]] bool is_level_at(const Eigen::Vector2d& p_body) const;

 private:
  BodyTiltParams params_;
  std::int64_t utime_ = 0;
  std::optional<Eigen::Vector3d> up_body_;
  Eigen::Vector2d ground_{0.0, 0.0};  ///< slope of the ground along x and y of the body [m/m]
};

}  // namespace adit
