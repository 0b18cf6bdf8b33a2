// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/lateral_control.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr double kLeast = 0.2;  // of a divisor: errors so large are none to drive on with

}  // namespace

double lateral_curvature(const TrackError& error, double path_curvature_1_m, double direction,
                         const LateralParams& params) {
  const double omega = 1.0 / params.response_m;
  const double c = std::max(kLeast, std::cos(error.heading_rad));
  const double nearer = std::max(kLeast, 1.0 - path_curvature_1_m * error.lateral_m);
  const double derivative = direction * std::sin(error.heading_rad);
  return path_curvature_1_m * c / nearer -
         (2.0 * params.damping * omega * derivative + omega * omega * error.lateral_m) / c;
}

}  // namespace adit
