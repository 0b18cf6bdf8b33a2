// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

namespace adit {

/// What one sub-ray of a beam brings back.
struct Echo {
  double range_m = 0.0;
  double power = 0.0;  ///< reflectivity · cos(incidence) / range² [1/m²]
};

/// What a laser makes of the echoes of one pulse of light. Surfaces within `pulse_length_m` of the
/// nearest run together: they are seen as one, at the mean of their ranges weighted by power
/// (a mixed pixel). Farther ones do not count. Where those that run together have less than
/// `first_share` of the power of all, they are passed over for those behind; where nobody has that
/// much, the strongest count. Nothing without echoes. Puts `echoes` into the order of range.
std::optional<Echo> seen_as_one(std::span<Echo> echoes, double pulse_length_m, double first_share);

}  // namespace adit
