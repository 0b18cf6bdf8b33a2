// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "sim/mesh/mesh_builder.hpp"
#include "sim/world/drift_line.hpp"
#include "sim/world/heights.hpp"
#include "sim/world/world.hpp"

namespace adit {

/// What one prop is given to put itself into the world.
struct PropSite {
  const std::vector<DriftLine>& drifts;
  const Heights& heights;
  MeshBuilder& builder;
  World& world;
  std::string what;        ///< which prop it is, for messages: `props.posts[2]`
  std::mt19937_64 random;  ///< its own, so that no prop changes another

  /// Uniformly random.
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  }
};

/// A point on the floor beside the middle of a drift, in world.
Eigen::Vector3d on_floor(const PropSite& site, const DriftLine& drift, double s_m, double across_m);

/// Axes at a place of a drift: x along it, y to its left, z up; the origin at `p_world`.
Eigen::Isometry3d drift_axes(const DriftLine& drift, double s_m, const Eigen::Vector3d& p_world);

/// Begins a part of the mesh that will be an obstacle. Returns what `end_obstacle` needs.
std::size_t begin_obstacle(PropSite& site, PartKind kind, Material material,
                           const std::string& name);

/// All vertices since `begin_obstacle` are one obstacle of the truth.
void end_obstacle(PropSite& site, std::size_t first_vertex);

}  // namespace adit
