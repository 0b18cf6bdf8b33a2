// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/world/plan/tunnel_line.hpp"
#include "sim/world/props/prop_descriptions.hpp"
#include "sim/world/surface/heights.hpp"

namespace adit {

/// z of the water's surface: that of the unchanged floor at the lower end of the section.
double water_level(const WaterDescription& water, const TunnelLine& tunnel, const Heights& heights);

/// The hollow under the water. It starts at the floor at both ends of the section and has the
/// described depth below `level_m` at half its length.
HeightChange water_hollow(const WaterDescription& water, const TunnelLine& tunnel, double level_m);

}  // namespace adit
