// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/world/prop_descriptions.hpp"
#include "sim/world/props/prop_site.hpp"

namespace adit {

// One prop: its surfaces into the mesh, what is true of it into the world. Each throws
// std::invalid_argument, naming the prop, for one in no drift or beyond its end.
void add_prop(const RailsDescription& rails, PropSite& site);
void add_prop(const PostsDescription& posts, PropSite& site);
void add_prop(const CribDescription& crib, PropSite& site);
void add_prop(const RubbleDescription& rubble, PropSite& site);
void add_prop(const BeamDescription& beam, PropSite& site);
void add_prop(const CarDescription& car, PropSite& site);
void add_prop(const LowRoofDescription& low_roof, PropSite& site);
void add_prop(const PitDescription& pit, PropSite& site);
void add_prop(const WaterDescription& water, PropSite& site);
void add_prop(const MudDescription& mud, PropSite& site);
void add_prop(const GasDescription& gas, PropSite& site);

}  // namespace adit
