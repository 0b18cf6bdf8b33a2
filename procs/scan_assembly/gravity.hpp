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
  int readings = 100;               ///< number of readings of the mean
  double deviation_max_m_s2 = 0.5;  ///< of the mean from 9.81; beyond, the body is not at rest

  template <class V>
  void visit(V& v) {
    v("readings", readings, within(1, 10'000));
    v("deviation_max_m_s2", deviation_max_m_s2, above(0.0));
  }
};

/// Estimates the up direction of a body at rest, as the mean of the last measurements of the
/// specific force.
class GravityEstimator {
 public:
  explicit GravityEstimator(const GravityParams& params) : params_(params) {}

  /// False for a reading that is not finite; it is ignored.
  bool add(const ImuReading& reading);

  /// Forgets the readings of the time in which the body may have moved.
  void clear() { forces_.clear(); }
  [[nodiscard]] bool has_all_readings() const {
    return forces_.size() >= static_cast<std::size_t>(params_.readings);
  }

  /// Unit vector in the body frame; nothing with too few readings, or if the body is not at rest.
  [[nodiscard]] std::optional<Eigen::Vector3d> up_body() const;

 private:
  GravityParams params_;
  std::deque<Eigen::Vector3d> forces_;  ///< the newest readings
};

/// R_level_body, the rotation that takes `up_body` to z and keeps the heading of the body's x axis.
Eigen::Matrix3d level_rotation(const Eigen::Vector3d& up_body);

}  // namespace adit
