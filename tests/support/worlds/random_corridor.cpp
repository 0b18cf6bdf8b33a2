// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/worlds/random_corridor.hpp"

#include <cmath>
#include <stdexcept>

#include "common/types/body_outline.hpp"
#include "sim/sweep/tilt_sweep.hpp"
#include "sim/vehicle/surroundings.hpp"
#include "sim/world/build_world.hpp"
#include "sim/world/random/random_generator.hpp"
#include "tests/support/worlds/corridor_obstacles.hpp"

namespace adit {
namespace {

constexpr int kCableSegments = 60;

void add_segment(TriangleMesh& mesh, const TriangleMesh& more) {
  const auto vertices = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto parts = static_cast<std::uint16_t>(mesh.parts.size());
  mesh.vertices.insert(mesh.vertices.end(), more.vertices.begin(), more.vertices.end());
  for (const auto& [a, b, c] : more.triangles) {
    mesh.triangles.push_back({a + vertices, b + vertices, c + vertices});
  }
  for (const std::uint16_t part : more.triangle_parts) {
    mesh.triangle_parts.push_back(static_cast<std::uint16_t>(part + parts));
  }
  mesh.parts.insert(mesh.parts.end(), more.parts.begin(), more.parts.end());
}

}  // namespace

void add_objects(World& world, const AddObjects& add) {
  MeshBuilder builder;
  add(builder, world);
  add_segment(world.mesh, builder.take());
}

void add_cable(MeshBuilder& builder, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
               double sag_m, double diameter_m) {
  std::vector<Eigen::Vector3d> line;
  for (int i = 0; i <= kCableSegments; ++i) {
    const double share = static_cast<double>(i) / kCableSegments;
    line.emplace_back(from + share * (to - from) -
                      4.0 * sag_m * share * (1.0 - share) * Eigen::Vector3d::UnitZ());
  }
  builder.begin_part(PartKind::kCable, Material::kSteel, "loose_cable");
  builder.tube(line, diameter_m / 2.0);
}

OrientedBox plan_box(const Pose2& T_world_plan, double middle_m, const Eigen::Vector3d& size,
                     double tilt_rad) {
  OrientedBox box;
  box.T_world_box = Eigen::Translation3d(T_world_plan.x, T_world_plan.y, middle_m) *
                    Eigen::AngleAxisd(T_world_plan.theta, Eigen::Vector3d::UnitZ()) *
                    Eigen::AngleAxisd(tilt_rad, Eigen::Vector3d::UnitX());
  box.half_size = size / 2.0;
  return box;
}

namespace {

constexpr double kLengthM = 26.0;
constexpr double kSegmentM = 4.0;  // from one bend of the tunnel to the next
constexpr double kAheadM = 8.0;
constexpr int kAttemptsMax = 100;

/// The centre line of a gently winding tunnel with at most one sharp bend.
std::vector<double> winding_line(RandomGenerator& rng) {
  std::vector<double> points{0.0, 0.0};
  const double sharp_at_m = rng.chance(0.3) ? rng.between(8.0, 16.0) : 2.0 * kLengthM;
  const double sharp = rng.side() * rng.between(0.25, 0.7);
  double heading = 0.0;
  for (double s = 0.0; s < kLengthM; s += kSegmentM) {
    heading += rng.between(-0.08, 0.08);
    if (s <= sharp_at_m && sharp_at_m < s + kSegmentM) heading += sharp;
    const std::size_t last = points.size() - 2;
    points.push_back(points[last] + kSegmentM * std::cos(heading));
    points.push_back(points[last + 1] + kSegmentM * std::sin(heading));
  }
  return points;
}

WorldDescription bare_tunnel(int seed, double width_m, RandomGenerator& rng) {
  WorldDescription mine;
  mine.name = "corridor";
  mine.seed = seed;
  mine.plan.tunnels.push_back({.name = "main", .points_m = winding_line(rng), .width_m = width_m});
  mine.heights.clearance_m = rng.between(1.75, 2.3);
  mine.heights.floor_relief = {.height_m = rng.between(0.01, 0.03), .length_m = 2.0};
  mine.heights.roof_relief = {.height_m = rng.between(0.03, 0.12), .length_m = 2.0};
  mine.wall_relief = {.height_m = rng.between(0.05, 0.1), .length_m = 1.5};
  mine.T_world_start = {1.0, 0.0, 0.0};
  return mine;
}

}  // namespace

RandomCorridorMine random_corridor_mine(int seed, const std::string& kind) {
  RandomGenerator rng(static_cast<std::uint64_t>(seed));
  const double width_m = kind == "narrow" ? rng.between(1.7, 2.3) : rng.between(2.6, 4.5);
  RandomCorridorMine mine{kind, bare_tunnel(seed, width_m, rng), {}};
  const double room_m = std::max(0.0, (width_m - 1.7) / 2.0);
  mine.across_m = rng.between(-1.0, 1.0) * std::min(room_m, 0.5);
  mine.heading_rad = rng.between(-0.15, 0.15);
  add_obstacles(mine, rng);
  return mine;
}

Corridor build_corridor(const RandomCorridorMine& mine) {
  World world = build_world(mine.description);
  for (const AddObjects& add : mine.objects) add_objects(world, add);
  Corridor corridor{mine.kind, tunnel_lines(mine.description.plan).front(), nullptr, {}, {}};
  corridor.site = std::make_unique<Site>(std::move(world));
  const auto station = corridor.tunnel.at(kCorridorStart);
  const Eigen::Vector2d p_world = corridor.tunnel.beside(kCorridorStart, mine.across_m);
  corridor.T_world_robot = {p_world.x(), p_world.y(), station.heading_rad + mine.heading_rad};
  corridor.T_world_body = standing(*corridor.site, corridor.T_world_robot);
  const Eigen::Vector2d to_target = corridor.tunnel.at(kCorridorStart + kAheadM).p_world - p_world;
  corridor.direction_rad = std::atan2(to_target.y(), to_target.x());
  return corridor;
}

Corridor random_corridor_with_robot(int seed, const Vehicle& vehicle, double room_m) {
  const Vehicle larger = with_outline_grown(vehicle, room_m);
  const auto& kinds = corridor_kinds();
  const std::string& kind = kinds[static_cast<std::size_t>(seed) % kinds.size()];
  for (int i = 0; i < kAttemptsMax; ++i) {
    try {
      Corridor corridor = build_corridor(random_corridor_mine(seed * kAttemptsMax + i, kind));
      if (!colliding_part(corridor.site->scene(), larger, corridor.T_world_body)) return corridor;
    } catch (const std::invalid_argument&) {  // the robot cannot stand there
    }
  }
  throw std::invalid_argument("no corridor in which the vehicle stands");
}

}  // namespace adit
