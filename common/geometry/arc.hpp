// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "common/geometry/pose2.hpp"

namespace adit {

/// Motion along an arc that begins along x: `length_m` long, turning by `turn_rad`. Exact.
inline Pose2 along_arc(double length_m, double turn_rad) {
  // The chord of an arc has half its turn: sin(t/2)/(t/2), whose series serves near zero.
  const double half = 0.5 * turn_rad;
  const double shrink = std::abs(half) < 1e-4 ? 1.0 - half * half / 6.0 : std::sin(half) / half;
  const double chord = length_m * shrink;
  return {chord * std::cos(half), chord * std::sin(half), turn_rad};
}

}  // namespace adit
