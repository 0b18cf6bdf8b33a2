// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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
double mirrored_share(double cos_incidence);

}  // namespace adit
