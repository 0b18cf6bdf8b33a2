// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/build_world.hpp"

#include <memory>
#include <optional>
#include <stdexcept>

#include "sim/world/mesh_world.hpp"
#include "sim/world/plan/open_space.hpp"
#include "sim/world/plan/tunnel_graph.hpp"
#include "sim/world/props/props.hpp"
#include "sim/world/surface/heights.hpp"
#include "sim/world/surface/mine_surface.hpp"

namespace adit {
namespace {

void check_start(const OpenSpace& space, const Pose2& T_world_start) {
  if (space.depth_m(T_world_start.translation()) > 0.0) return;
  throw std::invalid_argument("the start at x " + std::to_string(T_world_start.x) + ", y " +
                              std::to_string(T_world_start.y) + " is in rock");
}

/// The tunnels of an imported mesh are not known: each prop is rejected with its name.
void check_mesh_alone(const WorldDescription& description) {
  const PlanDescription& plan = description.plan;
  if (!plan.tunnels.empty() || !plan.panels.empty() || !plan.rooms.empty()) {
    throw std::invalid_argument("a world has either a mesh or a plan, not both");
  }
  Heights heights(description.heights, description.seed);
  MeshBuilder builder;
  World world;
  apply_height_changes(description.props, {}, heights);
  add_props(description.props, {}, heights, description.seed, builder, world);
}

World build_plan_world(const WorldDescription& description) {
  const std::vector<TunnelLine> tunnels = tunnel_lines(description.plan);
  const auto space = std::make_shared<OpenSpace>(description, tunnels);
  const auto bare_heights = std::make_shared<Heights>(description.heights, description.seed);
  Heights heights = *bare_heights;
  apply_height_changes(description.props, tunnels, heights);
  check_start(*space, description.T_world_start);

  World world;
  MeshBuilder builder;
  world.name = description.name;
  world.T_world_start = description.T_world_start;
  world.truth.tunnels = tunnel_graph(tunnels);
  world.truth.plan = add_mine_surface(*space, heights, description.grid_m,
                                      description.heights.clearance_m, builder);
  world.truth.floor_height = [space,
                              bare_heights](const Eigen::Vector2d& p) -> std::optional<double> {
    if (!(space->depth_m(p) > 0.0)) return std::nullopt;
    return bare_heights->floor(p);
  };
  add_props(description.props, tunnels, heights, description.seed, builder, world);
  world.mesh = builder.take();
  return world;
}

}  // namespace

World build_world(const WorldDescription& description) {
  if (description.mesh.file.empty()) return build_plan_world(description);
  check_mesh_alone(description);
  return build_mesh_world(description);
}

}  // namespace adit
