// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/speed_control.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr double kSampleSpacingM = 0.05;
constexpr double kEpsilon = 1e-9;
constexpr double kSteeringShare = 0.8;  // of the steering rate for the path, the rest for errors
constexpr double kStopS = 0.3;
constexpr double kCurvatureTolerance1M = 0.2;  // of the curvature at which the robot starts

/// The speed limit at an arc length, without that of braking.
double local_limit_m_s(const PathRun& run, double s_m, double speed_max_m_s,
                       const SpeedParams& params, double steering_rate_1_m_s) {
  const double ahead = run.curvature_1_m(s_m, s_m + 2.0 * kSampleSpacingM);
  const double behind = run.curvature_1_m(s_m - 2.0 * kSampleSpacingM, s_m);
  const double change = std::abs(ahead - behind) / (2.0 * kSampleSpacingM);
  const double curvature = std::max(std::abs(ahead), std::abs(behind));
  return std::min({clearance_share(run.clearance_m(s_m), params) * speed_max_m_s,
                   std::sqrt(params.lateral_acceleration_m_s2 / std::max(curvature, kEpsilon)),
                   kSteeringShare * steering_rate_1_m_s / std::max(change, kEpsilon)});
}

}  // namespace

double clearance_share(double clearance_m, const SpeedParams& params) {
  const double reducing_m = params.clearance_full_m - params.clearance_creep_m;
  return std::clamp((clearance_m - params.clearance_creep_m) / std::max(reducing_m, kEpsilon), 0.0,
                    1.0);
}

SpeedProfile::SpeedProfile(const PathRun& run, const SpeedParams& params, double speed_max_m_s,
                           double steering_rate_1_m_s)
    : creep_m_s_(std::min({params.creep_m_s, params.speed_m_s, speed_max_m_s})) {
  const auto segments =
      static_cast<std::size_t>(std::max(1.0, std::ceil(run.length_m() / kSampleSpacingM)));
  const double limit_m_s = std::min(params.speed_m_s, speed_max_m_s);
  spacing_m_ = run.length_m() / static_cast<double>(segments);
  squares_.assign(segments + 1, 0.0);
  for (std::size_t i = segments; i-- > 0;) {
    const double s_m = spacing_m_ * static_cast<double>(i);
    const double local_m_s = local_limit_m_s(run, s_m, limit_m_s, params, steering_rate_1_m_s);
    const double braking = squares_[i + 1] + 2.0 * params.braking_m_s2 * spacing_m_;
    squares_[i] = std::min(local_m_s * local_m_s, braking);
  }
}

double SpeedProfile::at(double s_m) const {
  const double sample = spacing_m_ > 0.0 ? std::max(0.0, s_m) / spacing_m_ : 0.0;
  const auto i = static_cast<std::size_t>(sample);
  if (i + 1 >= squares_.size()) return 0.0;
  const double square = std::lerp(squares_[i], squares_[i + 1], sample - static_cast<double>(i));
  return std::max(creep_m_s_, std::sqrt(square));
}

void CommandRamp::drive(double speed_m_s, double curvature_1_m, double seconds) {
  const double bound = steering_rate_1_m_s_ * seconds;
  curvature_1_m_ += std::clamp(curvature_1_m - curvature_1_m_, -bound, bound);
  const bool is_steered = std::abs(curvature_1_m - curvature_1_m_) <= kCurvatureTolerance1M;
  const bool remains_stopped = speed_m_s_ == 0.0 && !(has_stopped() && is_steered);
  if (remains_stopped || speed_m_s_ * speed_m_s < 0.0) return stop(seconds);
  const double reachable = std::abs(speed_m_s_) + acceleration_m_s2_ * seconds;
  speed_m_s_ = std::clamp(speed_m_s, -reachable, reachable);
  stopped_s_ = 0.0;
}

void CommandRamp::stop(double seconds) {
  stopped_s_ = speed_m_s_ == 0.0 ? stopped_s_ + seconds : 0.0;
  speed_m_s_ = 0.0;
}

bool CommandRamp::has_stopped() const { return stopped_s_ >= kStopS; }

}  // namespace adit
