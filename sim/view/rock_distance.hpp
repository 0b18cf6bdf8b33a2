// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/mesh/ray_scene.hpp"

namespace adit {

/// How far a ray gets to rock, through whatever stands in the way; at most `reach_m`. [m]
double distance_to_rock(const RayScene& scene, const Ray& ray, float reach_m);

}  // namespace adit
