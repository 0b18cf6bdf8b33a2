// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "common/geometry/pose2.hpp"

namespace adit {

/// Estimates the pose of the steered point from delayed and noisy poses: a Kalman filter with a
/// constant gain. Between poses it predicts the commanded motion, so that it does not lag behind
/// commands; each pose corrects the estimate with a time constant of `smoothing_s`.
class PoseFilter {
 public:
  // A larger step between poses, or a gap between their times, is no motion: the filter resets.
  static constexpr double kJumpM = 0.5;
  static constexpr double kJumpRad = 0.5;
  static constexpr double kGapS = 0.25;

  explicit PoseFilter(double smoothing_s) : smoothing_s_(smoothing_s) {}

  /// `utime` is that of the pose. A pose slightly older than the last one is ignored; after a step
  /// back in time of more than `kGapS` the filter resets.
  void add(std::int64_t utime, const Pose2& T_odom_steered);

  /// Sets the motion from now on.
  void set_motion(double speed_m_s, double curvature_1_m);

  /// Time of the newest pose; nothing before the first one.
  [[nodiscard]] std::optional<std::int64_t> utime() const;
  /// The predicted pose at a time near that of the newest pose; there must be one.
  [[nodiscard]] Pose2 at(std::int64_t utime) const;

 private:
  [[nodiscard]] double gain(double seconds) const;

  double smoothing_s_;
  std::int64_t utime_ = 0;
  Pose2 T_odom_steered_;
  int n_ = 0;  ///< poses since the last reset
  double speed_m_s_ = 0.0;
  double curvature_1_m_ = 0.0;
};

}  // namespace adit
