// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "sim/world/world_description.hpp"

namespace adit {

/// Parameters of a straight tunnel with one grade, to test on.
struct GradeTunnelParams {
  double grade_percent = 0.0;  ///< greatest slope of the floor without relief; rises if positive
  double over_m = 30.0;        ///< length of the stretch that is not level, 20 to 50
  bool sudden = false;         ///< the slope changes at once, not over 8 m
  bool rough = false;          ///< relief of the floor of 0.08 m, not 0.02 m
};

/// The parameters in a name `grade:PERCENT`, followed by any of `,sudden`, `,rough` and `,30m` (the
/// length of the stretch): `grade:-12,sudden,rough,50m`. Empty for a name that does not begin with
/// `grade:`. Throws std::runtime_error for one that does and is not valid.
std::optional<GradeTunnelParams> parse_grade_tunnel(const std::string& name);

/// A tunnel of 90 m along x, 3 m wide, from an entrance at 0, level but for a stretch that begins
/// at 20 m. `seed` is that of its reliefs.
WorldDescription grade_tunnel(const GradeTunnelParams& params, int seed);

}  // namespace adit
