// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>

#include <Eigen/Geometry>

namespace adit {

/// Where the body was and how a laser was tilted, not long ago.
class MotionHistory {
 public:
  struct Moment {
    std::int64_t utime = 0;
    Eigen::Isometry3d T_world_body = Eigen::Isometry3d::Identity();
    double tilt_rad = 0.0;
  };

  explicit MotionHistory(const Moment& first) : moments_{first} {}

  /// Later than those before.
  void add(const Moment& moment) { moments_.push_back(moment); }
  /// Nobody asks any more for what was before that time.
  void forget_before(std::int64_t utime);

  /// Some seconds after `utime`, between the moments that were added; the nearest of them outside.
  [[nodiscard]] Moment at(std::int64_t utime, double seconds) const;

 private:
  std::deque<Moment> moments_;
};

}  // namespace adit
