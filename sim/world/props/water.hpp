// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/world/plan/tunnel_line.hpp"
#include "sim/world/props/prop_descriptions.hpp"
#include "sim/world/surface/heights.hpp"

namespace adit {

/// z of the surface: that of the floor, where the water leaves it as it is, at the lower end of the
/// stretch.
double water_level(const WaterDescription& water, const TunnelLine& tunnel, const Heights& heights);

/// The hollow under the water. It begins at the floor at both ends of the stretch, and half-way is
/// as deep below `level_m` as described.
HeightChange water_hollow(const WaterDescription& water, const TunnelLine& tunnel, double level_m);

}  // namespace adit
