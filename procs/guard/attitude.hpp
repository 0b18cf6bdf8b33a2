// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/sensing/vehicle_readings.hpp"

namespace adit {

struct AttitudeParams {
  double settling_s = 1.0;          ///< in which the accelerometer corrects the gyroscopes
  double deviation_max_m_s2 = 1.5;  ///< from 9.81; beyond, the force is a bump and not gravity

  template <class V>
  void visit(V& v) {
    v("settling_s", settling_s, above(0.0));
    v("deviation_max_m_s2", deviation_max_m_s2, above(0.0));
  }
};

/// Which way is up, of a body that drives: the gyroscopes turn it on at once, and the specific
/// force corrects it slowly where it is about that of gravity (a complementary filter: Mahony,
/// Hamel, Pflimlin, "Nonlinear complementary filters on the special orthogonal group", IEEE TAC
/// 2008, without estimate of the bias). A bump of 30 m/s² over a rail does nothing.
class Attitude {
 public:
  explicit Attitude(const AttitudeParams& params) : params_(params) {}

  /// `at_us` by MonotonicTime, not before the last.
  void add(const ImuReading& reading, std::int64_t at_us);

  /// Unit vector in the body frame; nothing before the first reading that may be gravity.
  [[nodiscard]] const std::optional<Eigen::Vector3d>& up_body() const { return up_body_; }

  /// Whether a reading that may be gravity came in the last ten seconds: the gyroscopes alone go
  /// astray.
  [[nodiscard]] bool is_known(std::int64_t now_us) const;

 private:
  AttitudeParams params_;
  std::optional<Eigen::Vector3d> up_body_;
  std::optional<std::int64_t> last_us_;
  std::optional<std::int64_t> gravity_us_;
};

/// The angle of the body's x axis above the level [rad].
double pitch_up_rad(const Eigen::Vector3d& up_body);
/// The turn about the body's x axis [rad], positive where its left is higher.
double roll_rad(const Eigen::Vector3d& up_body);

}  // namespace adit
