// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/geometry/attitude.hpp"
#include "common/sensing/vehicle_readings.hpp"

namespace adit {

struct AttitudeFilterParams {
  double settling_s = 1.0;          ///< time constant of the correction by the accelerometer
  double deviation_max_m_s2 = 1.5;  ///< of the specific force from 9.81; beyond, it is a bump
  double bias_s = 0.0;  ///< time constant of the estimate of the gyroscopes' bias; 0: no estimate

  template <class V>
  void visit(V& v) {
    v("settling_s", settling_s, above(0.0));
    v("deviation_max_m_s2", deviation_max_m_s2, above(0.0));
    v("bias_s", bias_s, at_least(0.0));
  }
};

/// Estimates the up direction of a moving body by a complementary filter: it integrates the
/// gyroscopes, and the specific force corrects it slowly while its magnitude is about that of
/// gravity (Mahony, Hamel, Pflimlin, "Nonlinear complementary filters on the special orthogonal
/// group", IEEE TAC 2008, eq. 32). A bump of 30 m/s² over a rail has no effect.
class AttitudeFilter {
 public:
  explicit AttitudeFilter(const AttitudeFilterParams& params) : params_(params) {}

  /// `at_us` is the time of the reading, in a clock that does not decrease. `acceleration`: of the
  /// body as far as it is known, in the body frame [m/s²]; the rest of the force is gravity.
  void add(const ImuReading& reading, std::int64_t at_us,
           const Eigen::Vector3d& acceleration = Eigen::Vector3d::Zero());

  /// Unit vector in the body frame; nothing before the first reading of about gravity.
  [[nodiscard]] const std::optional<Eigen::Vector3d>& up_body() const { return up_body_; }

  /// Whether a reading of about gravity was received in the last 10 s: the gyroscopes alone drift.
  [[nodiscard]] bool is_known(std::int64_t now_us) const;

 private:
  AttitudeFilterParams params_;
  std::optional<Eigen::Vector3d> up_body_;
  Eigen::Vector3d bias_rad_s_ = Eigen::Vector3d::Zero();  ///< of the gyroscopes
  std::optional<std::int64_t> last_us_;
  std::optional<std::int64_t> gravity_us_;
};

/// Angle of the body's x axis above the horizontal plane [rad].
double pitch_up_rad(const Eigen::Vector3d& up_body);
/// Rotation about the body's x axis [rad], positive if its left side is higher.
double roll_rad(const Eigen::Vector3d& up_body);

}  // namespace adit
