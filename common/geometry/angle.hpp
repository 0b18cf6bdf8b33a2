// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>

namespace adit {

/// The same angle in (−π, π]. [rad]
inline double wrap_angle(double angle) {
  const double wrapped = std::remainder(angle, 2.0 * std::numbers::pi);
  return wrapped <= -std::numbers::pi ? std::numbers::pi : wrapped;
}

/// `a − b` in (−π, π], the only way in which angles are subtracted here. [rad]
inline double angle_diff(double a, double b) { return wrap_angle(a - b); }

constexpr double deg_to_rad(double degrees) { return degrees * std::numbers::pi / 180.0; }
constexpr double rad_to_deg(double radians) { return radians * 180.0 / std::numbers::pi; }

}  // namespace adit
