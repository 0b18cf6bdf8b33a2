// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/controllers.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr double kDivisorMin = 0.2;  // beyond it the error exceeds all limits of driving

}  // namespace

double lateral_curvature(const PathTrackingError& error, double path_curvature_1_m,
                         double direction, const LateralParams& params, double drift_rad) {
  const double omega = 1.0 / params.response_m;
  const double course_rad = error.heading_rad + drift_rad;
  const double c = std::max(kDivisorMin, std::cos(course_rad));
  const double divisor = std::max(kDivisorMin, 1.0 - path_curvature_1_m * error.lateral_m);
  const double derivative = direction * std::sin(course_rad);
  return path_curvature_1_m * c / divisor -
         (2.0 * params.damping * omega * derivative + omega * omega * error.lateral_m) / c;
}

double pursuit_curvature(const PathRun& run, double s_m, const Pose2& T_odom_steered,
                         double speed_m_s, const PurePursuitParams& params) {
  const double bound = std::max(params.lookahead_min_m, params.lookahead_max_m);
  const double ahead =
      std::clamp(params.lookahead_s * std::abs(speed_m_s), params.lookahead_min_m, bound);
  const Pose2 T_steered_target = between(T_odom_steered, run.at(s_m + ahead));
  return 2.0 * T_steered_target.y / T_steered_target.translation().squaredNorm();
}

}  // namespace adit
