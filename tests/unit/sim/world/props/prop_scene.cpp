// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/sim/world/props/prop_scene.hpp"

#include <algorithm>

namespace adit {
namespace {

PlanDescription two_tunnels() {
  PlanDescription plan;
  plan.tunnels.push_back({.name = "main", .points_m = {0, 0, 60, 0}, .width_m = 4.0});
  plan.tunnels.push_back({.name = "bent", .points_m = {0, 20, 30, 20, 50, 30}, .width_m = 3.0});
  return plan;
}

HeightsDescription level(const ReliefDescription& relief) {
  HeightsDescription heights;
  heights.floor_relief = relief;
  heights.roof_relief = relief;
  return heights;
}

}  // namespace

PropScene::PropScene(const PropDescriptions& props, const ReliefDescription& relief, int seed)
    : tunnels(tunnel_lines(two_tunnels())), heights(level(relief), seed) {
  apply_height_changes(props, tunnels, heights);
  MeshBuilder builder;
  add_props(props, tunnels, heights, seed, builder, world);
  world.mesh = builder.take();
  scene_.emplace(world.mesh);
}

const Obstacle* PropScene::obstacle(const std::string& name) const {
  const auto& all = world.truth.obstacles;
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Obstacle& o) { return o.name == name; });
  return found != all.end() ? &*found : nullptr;
}

std::optional<double> PropScene::range(const Eigen::Vector3d& from,
                                       const Eigen::Vector3d& direction,
                                       RayScene::Layer layer) const {
  const auto hit =
      scene_->cast({from.cast<float>(), direction.normalized().cast<float>()}, 100.0F, layer);
  if (!hit) return std::nullopt;
  return hit->distance_m;
}

}  // namespace adit
