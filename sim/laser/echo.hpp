// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "sim/mesh/triangle_mesh.hpp"

namespace adit {

/// Share of infrared light (905 nm) that a surface throws back diffusely when it faces the laser.
/// 0 for what gives nothing back: water, and a mirror, which sends the light elsewhere. The figures
/// are typical ones of dusty or wet surfaces; dirty raw timber as in the manual of the LMS-200.
double reflectivity(Material material);

/// The greatest reflectivity that there is.
double reflectivity_max();

/// Share of the light that still water mirrors at an angle of incidence: nearly all where it is
/// grazing, 2 % where it is steep. Fresnel's law after Schlick, "An inexpensive BRDF model for
/// physically-based rendering", 1994.
double specular_share(double cos_incidence);

/// What one sub-ray of a beam brings back.
struct Echo {
  double range_m = 0.0;
  double power = 0.0;  ///< reflectivity · cos(incidence) / range² [1/m²]
};

/// What a laser makes of the echoes of one pulse of light. Surfaces within `pulse_length_m` of the
/// nearest run together: they are seen as one, at the mean of their ranges weighted by power
/// (a mixed pixel). Farther ones do not count. Where those that run together have less than
/// `first_echo_share` of the power of all, they are passed over for those behind; where nobody has
/// that much, the strongest count. Nothing without echoes. Puts `echoes` into the order of range.
std::optional<Echo> merge_echoes(std::span<Echo> echoes, double pulse_length_m,
                                 double first_echo_share);

}  // namespace adit
