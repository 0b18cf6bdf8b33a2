// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <random>

#include <Eigen/Core>

#include "sim/mesh/mesh_builder.hpp"

namespace adit {

/// Adds a convex block of twenty facets with a random orientation, within `radius_m` of `middle`
/// (world).
void add_stone(const Eigen::Vector3d& middle, double radius_m, std::mt19937_64& random,
               MeshBuilder& builder);

}  // namespace adit
