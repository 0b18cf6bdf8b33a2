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
  double time_constant_s = 2.0;     ///< in which the accelerometer outweighs the gyro
  double deviation_max_m_s2 = 0.5;  ///< of the specific force from 9.81; beyond, it is not gravity
  double ground_m = 10.0;           ///< of the way, whose mean tilt is taken for that of the ground
  double rise_max_m = 0.4;          ///< that a beam may leave its height above the ground by

  template <class V>
  void visit(V& v) {
    v("time_constant_s", time_constant_s, above(0.0));
    v("deviation_max_m_s2", deviation_max_m_s2, above(0.0));
    v("ground_m", ground_m, above(0.0));
    v("rise_max_m", rise_max_m, above(0.0));
  }
};

/// How the body is tilted against the ground that it drives over, by gyro and accelerometer. A
/// body with a wheel in mud or on a rail looks at the floor ahead or behind, or at the roof. What
/// it sees there moves with it, like a wall that says that it stands.
class BodyTilt {
 public:
  explicit BodyTilt(const BodyTiltParams& params) : params_(params) {}

  /// Of readings whose times do not advance, and those that are not finite, nothing is taken.
  void add(const ImuReading& reading);
  /// The body has gone on by so much.
  void drive(double distance_m);

  /// Whether a beam of a level laser that ends at `p_body` is near the height of the laser above
  /// the ground there. Yes where nothing is known of the tilt.
  [[nodiscard]] bool is_level_at(const Eigen::Vector2d& p_body) const;

 private:
  BodyTiltParams params_;
  std::int64_t utime_ = 0;
  std::optional<Eigen::Vector3d> up_body_;
  Eigen::Vector2d ground_{0.0, 0.0};  ///< rise of the ground per metre along x and y of the body
};

}  // namespace adit
