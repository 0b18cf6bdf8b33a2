// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"

namespace adit {

struct WheelScaleParams {
  /// Of the scale before scans measured it: wheels that slip, and wear.
  double sd = 0.05;
  double span_m = 2.0;         ///< distance over which scans and wheels are compared
  double span_min_m = 0.5;     ///< a shorter one, where the scans end to measure, is not used
  double match_sd_m = 0.01;    ///< of the motion by scans over a span
  double m_per_sqrt_m = 0.03;  ///< random walk of the wheels
  /// Random walk of the scale, with other ground [1/√m].
  double walk_per_sqrt_m = 0.001;
  double deviation_max = 3.0;  ///< standard deviations; beyond, the wheels spin or a match slips

  template <class V>
  void visit(V& v) {
    v("sd", sd, within(0.0, 0.5));
    v("span_m", span_m, within(0.1, 100.0));
    v("span_min_m", span_min_m, within(0.0, 100.0));
    v("match_sd_m", match_sd_m, within(1e-4, 1.0));
    v("m_per_sqrt_m", m_per_sqrt_m, within(1e-4, 1.0));
    v("walk_per_sqrt_m", walk_per_sqrt_m, within(0.0, 0.1));
    v("deviation_max", deviation_max, above(0.0));
  }
};

/// Estimates the error of scale of the wheel odometry from the stretches where scans alone measure
/// the motion along the body, for those where only the wheels do. A Kalman filter of one state:
/// metres over ground for each metre that the wheels measured (Borenstein and Feng, "Measurement
/// and correction of systematic odometry errors in mobile robots", 1996, where it is the ratio of
/// the mean actual to the nominal wheel diameter, with the mean slip included here).
class WheelScale {
 public:
  explicit WheelScale(const WheelScaleParams& params)
      : params_(params), variance_(params.sd * params.sd) {}

  /// Adds a motion of the body. `wheels_step`: by the wheels, along the ground, unscaled, in the
  /// body frame before the motion. `scans_step`: the same in the level plane by scans; empty if
  /// they did not measure it along the body. `level_share`: length in the level plane per length
  /// along the ground.
  void add(const Pose2& wheels_step, double level_share, const std::optional<Pose2>& scans_step);

  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] double sd() const;

 private:
  void end_span();

  WheelScaleParams params_;
  double scale_ = 1.0;
  double variance_;
  double wheels_m_ = 0.0;  ///< of the current span, in the level plane
  double scans_m_ = 0.0;
};

}  // namespace adit
