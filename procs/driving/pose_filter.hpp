// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "common/geometry/pose2.hpp"

namespace adit {

/// Where the steered point is, from poses that come late and with noise: between them it moves as
/// it was told to, and each pose corrects that by a share that makes errors fall by e in
/// `smoothing_s` (Kalman's filter with a constant gain). What is told, the filter does not lag.
class PoseFilter {
 public:
  /// A step from pose to pose that is no motion: the filter begins anew.
  static constexpr double kJumpM = 0.5;
  static constexpr double kJumpRad = 0.5;
  static constexpr double kGapS = 0.25;

  explicit PoseFilter(double smoothing_s) : smoothing_s_(smoothing_s) {}

  /// Of a time [µs since the epoch]. One that is a little older than the last is ignored; time that
  /// goes back further than `kGapS` is another time, and the filter begins anew.
  void add(std::int64_t utime, const Pose2& T_odom_steered);

  /// How it moves from now on.
  void set_motion(double speed_m_s, double curvature_1_m);

  /// Time of the newest pose; nothing before the first.
  [[nodiscard]] std::optional<std::int64_t> utime() const;
  /// Pose at a time near to that of the newest; there must have been one.
  [[nodiscard]] Pose2 at(std::int64_t utime) const;

 private:
  [[nodiscard]] double gain(double seconds) const;

  double smoothing_s_;
  std::int64_t utime_ = 0;
  Pose2 T_odom_steered_;
  int n_ = 0;  ///< poses since the beginning
  double speed_m_s_ = 0.0;
  double curvature_1_m_ = 0.0;
};

}  // namespace adit
