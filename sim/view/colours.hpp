// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "sim/mesh/triangle_mesh.hpp"
#include "sim/view/render.hpp"

namespace adit {

/// The colour of a part in white light, without grain.
Rgb plain_colour(const Part& part);

/// The colour at a place of it. Rock, floor and timber have a grain, fixed in the world.
Rgb colour_at(const Part& part, const Eigen::Vector3f& p_world);

}  // namespace adit
