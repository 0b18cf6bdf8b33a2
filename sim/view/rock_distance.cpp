// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/view/rock_distance.hpp"

#include "sim/view/shading.hpp"

namespace adit {

double distance_to_rock(const RayScene& scene, const Ray& ray, float reach_m) {
  Ray rest = ray;
  float done_m = 0.0F;
  while (const auto hit = scene.cast(rest, reach_m - done_m)) {
    if (is_rock(scene.mesh().part_of(hit->triangle).kind)) return done_m + hit->distance_m;
    rest.origin = surface_point(rest, {hit->distance_m, hit->triangle, -hit->normal}).p_world;
    done_m = (rest.origin - ray.origin).norm();
    if (done_m >= reach_m) break;
  }
  return reach_m;
}

}  // namespace adit
