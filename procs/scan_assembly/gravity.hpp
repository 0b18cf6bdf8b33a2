// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <optional>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/sensing/vehicle_readings.hpp"

namespace adit {

struct GravityParams {
  int readings = 100;               ///< that the mean is taken of; with fewer there is none
  double deviation_max_m_s2 = 0.5;  ///< of the mean from 9.81; beyond, the body does not stand

  template <class V>
  void visit(V& v) {
    v("readings", readings, within(1, 10'000));
    v("deviation_max_m_s2", deviation_max_m_s2, above(0.0));
  }
};

/// Which way is up, of a body at rest: against the pull of gravity, as the mean of the specific
/// force that was measured last.
class GravityEstimator {
 public:
  explicit GravityEstimator(const GravityParams& params) : params_(params) {}

  /// False for a reading that is not finite; it is not used.
  bool add(const ImuReading& reading);

  /// Unit vector in the body frame. Nothing without enough readings, or where they are not those of
  /// a body at rest.
  [[nodiscard]] std::optional<Eigen::Vector3d> up_body() const;

 private:
  GravityParams params_;
  std::deque<Eigen::Vector3d> forces_;  ///< the newest
};

/// The rotation that makes a body level: takes `up_body` to z and leaves the direction of the
/// body's x axis in the plan as it is.
Eigen::Matrix3d level_rotation(const Eigen::Vector3d& up_body);

}  // namespace adit
