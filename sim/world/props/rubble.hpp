// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <random>

#include <Eigen/Core>

#include "sim/mesh/mesh_builder.hpp"

namespace adit {

/// A convex block of twenty facets, turned at random, at most `radius_m` from `middle` (world).
void add_stone(const Eigen::Vector3d& middle, double radius_m, std::mt19937_64& random,
               MeshBuilder& builder);

}  // namespace adit
