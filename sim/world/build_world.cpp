// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/build_world.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "common/text/message_text.hpp"
#include "sim/mesh/mesh_file.hpp"
#include "sim/mesh/mesh_slice.hpp"
#include "sim/mesh/triangle_mesh.hpp"
#include "sim/world/plan/level_plan.hpp"
#include "sim/world/plan/open_space.hpp"
#include "sim/world/plan/plan_shapes.hpp"
#include "sim/world/plan/tunnel_graph.hpp"
#include "sim/world/props/props.hpp"
#include "sim/world/surface/heights.hpp"
#include "sim/world/surface/mine_surface.hpp"

namespace adit {
namespace {

// A surface with less free height above it is not floor.
constexpr double kHeadroom = 0.5;

/// A level rectangle that covers the mesh.
void add_flat(TriangleMesh& mesh, const Eigen::AlignedBox3f& box, double z_m, const Part& part) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto z = static_cast<float>(z_m);
  mesh.vertices.insert(mesh.vertices.end(), {{box.min().x(), box.min().y(), z},
                                             {box.max().x(), box.min().y(), z},
                                             {box.max().x(), box.max().y(), z},
                                             {box.min().x(), box.max().y(), z}});
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
  mesh.triangle_parts.insert(mesh.triangle_parts.end(), 2,
                             static_cast<std::uint16_t>(mesh.parts.size()));
  mesh.parts.push_back(part);
}

TriangleMesh load(const MeshDescription& description) {
  TriangleMesh mesh = load_mesh_file(description.file, {description.scale, description.up.at(0)});
  const Eigen::AlignedBox3f box = mesh_bounds(mesh);
  if (description.flat_floor) {
    add_flat(mesh, box, description.floor_m, {PartKind::kFloor, Material::kRock, "flat floor"});
  }
  if (description.flat_roof) {
    add_flat(mesh, box, description.roof_m, {PartKind::kRoof, Material::kRock, "flat roof"});
  }
  return mesh;
}

/// Finds the floor of a mesh.
class MeshGround {
 public:
  explicit MeshGround(TriangleMesh mesh)
      : mesh_(std::move(mesh)), scene_(mesh_), box_(mesh_bounds(mesh_)) {}

  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }

  /// The lowest surface that has kHeadroom above it, and is not a roof.
  [[nodiscard]] std::optional<double> floor(const Eigen::Vector2d& p_world) const {
    constexpr float kAbove = 1e-3F;  // above a surface, where the search for the next one starts
    const float top = box_.max().z() + 1.0F;
    Eigen::Vector3f from(static_cast<float>(p_world.x()), static_cast<float>(p_world.y()),
                         box_.min().z() - 1.0F);
    std::optional<float> below;
    while (from.allFinite()) {
      const auto hit =
          scene_.cast({from, Eigen::Vector3f::UnitZ()}, top - from.z(), RayScene::Layer::kSolid);
      const float surface = hit ? from.z() + hit->distance_m : top;
      if (below && (!hit || surface - *below >= kHeadroom)) return *below;
      if (!hit) break;
      below.reset();
      if (mesh_.part_of(hit->triangle).kind != PartKind::kRoof) below = surface;
      from.z() = surface + kAbove;
    }
    return std::nullopt;
  }

  /// Whether walls surround a point of the plan: most horizontal rays from it, at the height of the
  /// lasers, hit something.
  [[nodiscard]] bool is_enclosed(const Eigen::Vector2d& p_world, double floor_m) const {
    constexpr int kRays = 72;
    const Eigen::Vector3d from(p_world.x(), p_world.y(), floor_m + kOutlineHeight);
    const float range = box_.diagonal().norm();
    int hits = 0;
    for (int i = 0; i < kRays; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kRays;
      const Eigen::Vector3d direction(std::cos(angle), std::sin(angle), 0.0);
      const auto hit = scene_.cast({from.cast<float>(), direction.cast<float>()}, range,
                                   RayScene::Layer::kSolid);
      hits += hit ? 1 : 0;
    }
    return 2 * hits > kRays;
  }

  /// The middle of a triangle with floor and a surface above, nearest to a point of the plan; empty
  /// if there is none.
  [[nodiscard]] std::optional<Eigen::Vector2d> nearest_floor(const Eigen::Vector2d& p_world) const {
    std::vector<std::pair<double, Eigen::Vector2d>> places;
    for (const auto& [a, b, c] : mesh_.triangles) {
      const Eigen::Vector3f middle =
          (mesh_.vertices[a] + mesh_.vertices[b] + mesh_.vertices[c]) / 3.0F;
      const Eigen::Vector2d p = middle.head<2>().cast<double>();
      places.emplace_back((p - p_world).norm(), p);
    }
    std::sort(places.begin(), places.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [distance_m, p] : places) {
      const auto floor_m = floor(p);
      if (floor_m && is_covered(p, *floor_m) && is_enclosed(p, *floor_m)) return p;
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] bool is_covered(const Eigen::Vector2d& p_world, double floor_m) const {
    const Eigen::Vector3d from(p_world.x(), p_world.y(), floor_m + kHeadroom / 2.0);
    return scene_
        .cast({from.cast<float>(), Eigen::Vector3f::UnitZ()}, box_.sizes().z() + 1.0F,
              RayScene::Layer::kSolid)
        .has_value();
  }

  TriangleMesh mesh_;
  RayScene scene_;
  Eigen::AlignedBox3f box_;
};

/// Rejects a start without floor, or beside the mine where floor or roof were added; says where it
/// could be. Returns the height of the floor.
double floor_at_start(const MeshGround& ground, const WorldDescription& description) {
  const Eigen::Vector2d start = description.T_world_start.translation();
  const std::optional<double> floor_m = ground.floor(start);
  const bool added = description.mesh.flat_floor || description.mesh.flat_roof;
  if (floor_m && (!added || ground.is_enclosed(start, *floor_m))) return *floor_m;
  const auto place = ground.nearest_floor(start);
  throw std::invalid_argument(fmt::format(
      "{} at the start, x {:g}, y {:g}; {}",
      floor_m ? "there are no walls around the floor" : "the mesh has no floor", start.x(),
      start.y(),
      place ? fmt::format(
                  "the nearest one is at x {:.1f}, y {:.1f}: set T_world_start in a world file",
                  place->x(), place->y())
            : "there is none with walls around it and rock above"));
}

bool is_inside(const PlanRing& ring, const Eigen::Vector2d& p_world) {
  return depth_m(PlanPolygon{ring.points}, p_world) > 0.0;
}

/// Orients the ring.
PlanRing directed(PlanRing ring, bool pillar) {
  if (ring.is_pillar() != pillar) std::reverse(ring.points.begin(), ring.points.end());
  return ring;
}

/// The smallest ring around the start, and the rings directly inside it.
std::vector<PlanRing> rings_around(const Eigen::Vector2d& start, std::vector<PlanRing> rings) {
  std::sort(rings.begin(), rings.end(), [](const PlanRing& a, const PlanRing& b) {
    return std::abs(a.signed_area_m2()) > std::abs(b.signed_area_m2());
  });
  const auto outer = std::find_if(rings.rbegin(), rings.rend(),
                                  [&](const PlanRing& ring) { return is_inside(ring, start); });
  if (outer == rings.rend()) return {};
  std::vector<PlanRing> plan{directed(*outer, false)};
  for (auto ring = outer.base(); ring != rings.end(); ++ring) {
    const Eigen::Vector2d& p = ring->points[0];
    const bool in_other = std::any_of(plan.begin() + 1, plan.end(),
                                      [&](const PlanRing& other) { return is_inside(other, p); });
    if (is_inside(plan[0], p) && !in_other) plan.push_back(directed(*ring, true));
  }
  return plan;
}

World build_mesh_world(const WorldDescription& description) {
  const auto ground = std::make_shared<MeshGround>(load(description.mesh));
  const Eigen::Vector2d start = description.T_world_start.translation();
  const double floor_m = floor_at_start(*ground, description);
  World world;
  world.name = description.name;
  world.mesh = ground->mesh();
  world.T_world_start = description.T_world_start;
  std::vector<PlanRing> rings;
  for (auto& loop : slice(world.mesh, floor_m + kOutlineHeight)) rings.push_back({std::move(loop)});
  world.truth.plan = rings_around(start, std::move(rings));
  world.truth.floor_height = [ground](const Eigen::Vector2d& p) { return ground->floor(p); };
  return world;
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

/// One level of a plan: rooms, pillars and panels are on level 0.
struct Level {
  int number = 0;
  std::vector<TunnelLine> tunnels;  ///< with those that continue the level
  std::shared_ptr<const OpenSpace> space;
  std::shared_ptr<const Heights> bare_heights;

  [[nodiscard]] std::optional<double> floor(const Eigen::Vector2d& p_world) const {
    if (!(space->depth_m(p_world) > 0.0)) return std::nullopt;
    return bare_heights->floor(p_world);
  }
};

WorldDescription with_rooms_of(WorldDescription description, int level) {
  if (level == 0) return description;
  description.plan.rooms.clear();
  description.plan.pillars.clear();
  return description;
}

std::vector<Level> levels_of(const WorldDescription& description, const LevelPlan& plan) {
  Eigen::AlignedBox2d all;
  if (plan.levels().size() > 1) {  // levels have the same grid, so that they fit together
    for (const int level : plan.levels()) {
      all.extend(OpenSpace(with_rooms_of(description, level), plan.lines_on(level)).bounds());
    }
  }
  std::vector<Level> levels;
  for (const int level : plan.levels()) {
    const WorldDescription own = with_rooms_of(description, level);
    const std::vector<TunnelLine> tunnels = plan.lines_on(level);
    const auto space = std::make_shared<OpenSpace>(own, tunnels, all);
    const auto rises =
        TunnelRises::of(tunnels, polygons_of(own.plan.rooms, "room"), space->reach_m());
    levels.push_back({level, tunnels, space,
                      std::make_shared<Heights>(description.heights, description.seed, rises)});
  }
  return levels;
}

/// Removes the props of other levels from a list. Those of unknown tunnels stay on level `first`,
/// to be rejected there.
template <class Prop>
void keep_level(const std::vector<TunnelLine>& tunnels, int level, int first,
                std::vector<Prop>& props) {
  std::erase_if(props, [&](const Prop& prop) {
    const auto tunnel = std::find_if(tunnels.begin(), tunnels.end(), [&](const TunnelLine& line) {
      return line.name == prop.tunnel;
    });
    return (tunnel == tunnels.end() ? first : tunnel->level) != level;
  });
}

PropDescriptions props_on(const std::vector<TunnelLine>& tunnels, int level, int first,
                          PropDescriptions props) {
  keep_level(tunnels, level, first, props.rails);
  keep_level(tunnels, level, first, props.posts);
  keep_level(tunnels, level, first, props.cribs);
  keep_level(tunnels, level, first, props.rubble);
  keep_level(tunnels, level, first, props.beams);
  keep_level(tunnels, level, first, props.cars);
  keep_level(tunnels, level, first, props.low_roofs);
  keep_level(tunnels, level, first, props.pits);
  return props;
}

/// What is known by its place in the plan alone cannot tell levels apart.
void check_props_of_levels(const PropDescriptions& props, std::size_t levels) {
  if (levels < 2 || (props.water.empty() && props.mud.empty() && props.gas.empty())) return;
  throw std::invalid_argument("water, mud and gas need a world of one level");
}

void check_start(const std::vector<Level>& levels, const WorldDescription& description) {
  const Eigen::Vector2d start = description.T_world_start.translation();
  const auto level = std::find_if(levels.begin(), levels.end(), [&](const Level& one) {
    return one.number == description.start_level;
  });
  if (level == levels.end()) {
    throw std::invalid_argument(
        fmt::format("start_level is {}, but no tunnel is on that level", description.start_level));
  }
  if (level->space->depth_m(start) > 0.0) return;
  const TunnelLine* nearest = nullptr;
  for (const TunnelLine& tunnel : level->tunnels) {
    if (nearest == nullptr || tunnel.distance_m(start) < nearest->distance_m(start)) {
      nearest = &tunnel;
    }
  }
  std::string advice;
  if (nearest != nullptr) {
    const Eigen::Vector2d p = nearest->at(nearest->place_of(start).s_m).p_world;
    advice = fmt::format("; the nearest tunnel, {}, is at x {:.1f}, y {:.1f}", quote(nearest->name),
                         p.x(), p.y());
  }
  throw std::invalid_argument(
      fmt::format("the start at x {:g}, y {:g} is in rock{}", start.x(), start.y(), advice));
}

/// The floors of the levels.
void add_floors(const std::vector<Level>& levels, int start_level, WorldTruth& truth) {
  truth.levels.clear();
  for (const Level& level : levels) truth.levels.push_back(level.number);
  const auto shared = std::make_shared<const std::vector<Level>>(levels);
  const auto floor = [shared](const Eigen::Vector2d& p, int number) -> std::optional<double> {
    for (const Level& level : *shared) {
      if (level.number == number) return level.floor(p);
    }
    return std::nullopt;
  };
  truth.floor_height = [shared, floor,
                        start_level](const Eigen::Vector2d& p) -> std::optional<double> {
    auto height = floor(p, start_level);
    for (const Level& level : *shared) {
      if (!height) height = level.floor(p);
    }
    return height;
  };
  if (levels.size() > 1) truth.level_floor_height = floor;
}

World build_plan_world(const WorldDescription& description) {
  const std::vector<TunnelLine> tunnels = tunnel_lines(description.plan);
  const LevelPlan plan(tunnels);
  const std::vector<Level> levels = levels_of(description, plan);
  check_start(levels, description);
  check_props_of_levels(description.props, levels.size());

  World world;
  MeshBuilder builder;
  world.name = description.name;
  world.T_world_start = description.T_world_start;
  world.start_level = description.start_level;
  world.truth.tunnels = tunnel_graph(tunnels);
  add_floors(levels, description.start_level, world.truth);
  SharedVertices shared;
  std::vector<Heights> heights;
  std::vector<PropDescriptions> props;
  for (const Level& level : levels) {
    const int number = level.number;
    props.push_back(props_on(tunnels, number, plan.levels().front(), description.props));
    heights.push_back(*level.bare_heights);
    apply_height_changes(props.back(), tunnels, heights.back());
    const OwnedPart part{
        [&plan, number](const Eigen::Vector2d& p) { return plan.owns(number, p); },
        [&plan, number](const Eigen::Vector2d& p) { return plan.is_at_joint(number, p); }};
    for (PlanRing& ring :
         add_mine_surface(*level.space, heights.back(), description.grid_m,
                          description.heights.clearance_m, part, shared, builder)) {
      ring.level = number;
      world.truth.plan.push_back(std::move(ring));
    }
  }
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const std::size_t first = world.truth.obstacles.size();
    add_props(props[i], tunnels, heights[i], description.seed, builder, world);
    for (std::size_t k = first; k < world.truth.obstacles.size(); ++k) {
      world.truth.obstacles[k].level = levels[i].number;
    }
  }
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
