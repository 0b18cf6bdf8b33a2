// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace adit {

/// Range of a beam on the straight line through the ends of two others in a plane with it [m],
/// given their ranges and their angles from the beam, to either side: 1 / r is A cos φ + B sin φ
/// along a line. The angles must not both be 0.
inline double range_on_line_m(double r1, double before_rad, double r2, double after_rad) {
  return std::sin(before_rad + after_rad) / (std::sin(after_rad) / r1 + std::sin(before_rad) / r2);
}

}  // namespace adit
