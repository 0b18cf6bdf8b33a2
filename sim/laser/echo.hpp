// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "sim/mesh/triangle_mesh.hpp"

namespace adit {

/// Diffuse reflectivity of a material at normal incidence for infrared light (905 nm), 0 to 1; 0
/// for water and for a mirror, which return no diffuse light. Typical values of dusty or wet
/// surfaces; that of dirty raw timber is from the manual of the LMS-200.
double reflectivity(Material material);

/// The greatest reflectivity of all materials.
double reflectivity_max();

/// Specular reflectance of still water: close to 1 at grazing incidence, 0.02 at normal incidence.
/// Fresnel's law after Schlick, "An inexpensive BRDF model for physically-based rendering", 1994.
double specular_share(double cos_incidence);

/// The echo of one sub-ray of a beam.
struct Echo {
  double range_m = 0.0;
  double power = 0.0;  ///< reflectivity · cos(incidence) / range² [1/m²]
};

/// Computes the echo that a laser measures from the echoes of one pulse. Echoes within
/// `pulse_length_m` of the nearest merge into one, at their mean range weighted by power (a mixed
/// pixel); farther echoes are ignored. If the merged echoes have less than `first_echo_share` of
/// the total power, the next group behind them is used; if no group has that much, the strongest
/// group is. Returns nothing without echoes. Sorts `echoes` by range.
std::optional<Echo> merge_echoes(std::span<Echo> echoes, double pulse_length_m,
                                 double first_echo_share);

}  // namespace adit
