// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include <Eigen/Core>

#include "sim/mesh/ray_scene.hpp"
#include "sim/mesh/triangle_mesh.hpp"

namespace adit {

/// A place on a surface, for the computation of light.
struct SurfacePoint {
  Eigen::Vector3f p_world;
  Eigen::Vector3f normal;  ///< unit, towards where it is seen from
};

/// Where a ray meets a surface; drawn back from it by a hair, so that rays that leave do not meet
/// the surface itself.
SurfacePoint surface_point(const Ray& ray, const RayHit& hit);

/// Whether it is the mine itself and nothing that stands or lies in it.
bool is_mine_surface(PartKind kind);

/// For each place the share of the light from all around that reaches it, when what lies farther
/// off than `reach_m` does not count (ambient occlusion). Four places one after another are taken
/// for samples of one pixel and look to different sides, two rays each, so that their mean is
/// smooth.
void find_openness(const RayScene& scene, std::span<const SurfacePoint> points, float reach_m,
                   std::span<float> openness);

/// How far a ray gets to rock, through whatever stands in the way; at most `reach_m`. [m]
double distance_to_rock(const RayScene& scene, const Ray& ray, float reach_m);

}  // namespace adit
