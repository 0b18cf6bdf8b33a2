// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/speed_profile.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr double kSpacingM = 0.05;
constexpr double kTiny = 1e-9;
constexpr double kSteeringShare = 0.8;  // of its rate, for the path; the rest is for errors

/// What holds at a place, whatever comes behind it.
double limit(const PathRun& run, double s_m, double fastest, const SpeedParams& params,
             double steering_rate_1_m_s) {
  const double ahead = run.curvature_1_m(s_m, s_m + 2.0 * kSpacingM);
  const double behind = run.curvature_1_m(s_m - 2.0 * kSpacingM, s_m);
  const double change = std::abs(ahead - behind) / (2.0 * kSpacingM);
  const double bend = std::max(std::abs(ahead), std::abs(behind));
  const double room = std::clamp(run.clearance_m(s_m) / params.clearance_full_m, 0.0, 1.0);
  return std::min({room * fastest,
                   std::sqrt(params.lateral_acceleration_m_s2 / std::max(bend, kTiny)),
                   kSteeringShare * steering_rate_1_m_s / std::max(change, kTiny)});
}

}  // namespace

SpeedProfile::SpeedProfile(const PathRun& run, const SpeedParams& params, double speed_max_m_s,
                           double steering_rate_1_m_s)
    : creep_m_s_(std::min({params.creep_m_s, params.speed_m_s, speed_max_m_s})) {
  const auto pieces =
      static_cast<std::size_t>(std::max(1.0, std::ceil(run.length_m() / kSpacingM)));
  const double fastest = std::min(params.speed_m_s, speed_max_m_s);
  spacing_m_ = run.length_m() / static_cast<double>(pieces);
  squares_.assign(pieces + 1, 0.0);
  for (std::size_t i = pieces; i-- > 0;) {
    const double s_m = spacing_m_ * static_cast<double>(i);
    const double here = limit(run, s_m, fastest, params, steering_rate_1_m_s);
    const double braking = squares_[i + 1] + 2.0 * params.acceleration_m_s2 * spacing_m_;
    squares_[i] = std::min(here * here, braking);
  }
}

double SpeedProfile::at(double s_m) const {
  const double place = spacing_m_ > 0.0 ? std::max(0.0, s_m) / spacing_m_ : 0.0;
  const auto i = static_cast<std::size_t>(place);
  if (i + 1 >= squares_.size()) return 0.0;
  const double square = std::lerp(squares_[i], squares_[i + 1], place - static_cast<double>(i));
  return std::max(creep_m_s_, std::sqrt(square));
}

}  // namespace adit
