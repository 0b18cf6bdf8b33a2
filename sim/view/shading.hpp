// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include <Eigen/Core>

#include "sim/mesh/ray_scene.hpp"
#include "sim/mesh/triangle_mesh.hpp"

namespace adit {

/// A point on a surface for the computation of light.
struct ShadedPoint {
  Eigen::Vector3f p_world;
  Eigen::Vector3f normal;  ///< unit normal, towards the camera
};

/// The intersection of a ray with a surface, moved slightly back, so that rays from it do not hit
/// the surface itself.
ShadedPoint shaded_point(const Ray& ray, const RayHit& hit);

/// Whether the part is the mine itself, not a prop.
bool is_mine_surface(PartKind kind);

/// Ambient occlusion: for each point, the fraction of ambient light that is not blocked within
/// `reach_m`. Four consecutive points are samples of one pixel and use different directions, two
/// rays each, so that their mean is smooth.
void find_openness(const RayScene& scene, std::span<const ShadedPoint> points, float reach_m,
                   std::span<float> openness);

/// Distance along a ray to rock, through props, at most `reach_m` [m].
double distance_to_rock(const RayScene& scene, const Ray& ray, float reach_m);

}  // namespace adit
