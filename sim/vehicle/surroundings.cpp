// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/vehicle/surroundings.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "common/geometry/clipping.hpp"
#include "common/geometry/ring.hpp"
#include "common/types/body_outline.hpp"

namespace adit {
namespace {

constexpr float kAboveM = 1.0F;
constexpr float kBehindSurfaceM = 1e-3F;

/// Lowest and highest vertex [m]; low > high for a mesh without vertices.
std::pair<float, float> span_z(const TriangleMesh& mesh) {
  float low = std::numeric_limits<float>::max();
  float high = std::numeric_limits<float>::lowest();
  for (const Eigen::Vector3f& vertex : mesh.vertices) {
    if (!vertex.allFinite()) continue;
    low = std::min(low, vertex.z());
    high = std::max(high, vertex.z());
  }
  return {low, high};
}

/// Whether a triangle of the mesh reaches into the body, which has the same outline from the belly
/// to the top.
bool is_within(const TriangleMesh& mesh, std::uint32_t triangle, const Vehicle& vehicle,
               const ConvexPolygon& outline, const Eigen::Isometry3d& T_body_world) {
  std::vector<Eigen::Vector3d> corners;
  for (const std::uint32_t vertex : mesh.triangles[triangle])
    corners.emplace_back(T_body_world * mesh.vertices[vertex].cast<double>());
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  corners = clipped(corners, up, vehicle.height_m);
  corners = clipped<Eigen::Vector3d>(corners, -up, -vehicle.belly_clearance_m);
  for (const ConvexPolygon::Edge& edge : outline.edges()) {
    const Eigen::Vector3d normal(edge.normal.x(), edge.normal.y(), 0.0);
    corners = clipped(corners, normal, edge.offset_m);
  }
  return !corners.empty();
}

}  // namespace

std::optional<std::string> colliding_part(const RayScene& scene, const Vehicle& vehicle,
                                          const Eigen::Isometry3d& T_world_body) {
  const double middle_z = 0.5 * (vehicle.belly_clearance_m + vehicle.height_m);
  const double half_z = 0.5 * (vehicle.height_m - vehicle.belly_clearance_m);
  OrientedBox box;
  box.T_world_box = T_world_body * Eigen::Translation3d(0.0, 0.0, middle_z);
  box.half_size = {0.5 * vehicle.length_m, 0.5 * vehicle.width_m, half_z};
  std::vector<std::uint32_t> triangles = scene.touching(box);
  if (!vehicle.footprint.empty()) {
    const ConvexPolygon outline = body_outline(vehicle);
    const Eigen::Isometry3d T_body_world = T_world_body.inverse();
    std::erase_if(triangles, [&](std::uint32_t triangle) {
      return !is_within(scene.mesh(), triangle, vehicle, outline, T_body_world);
    });
  }
  if (triangles.empty()) return std::nullopt;
  return scene.mesh().part_of(triangles.front()).name;
}

std::optional<double> floor_with_headroom(const RayScene& scene, const Vehicle& vehicle,
                                          const Eigen::Vector2d& p_world) {
  const auto [low, high] = span_z(scene.mesh());
  std::optional<double> floor;
  float above = std::numeric_limits<float>::infinity();  // the previous surface, going down
  float z = high + kAboveM;
  while (z > low) {
    const Ray down{{static_cast<float>(p_world.x()), static_cast<float>(p_world.y()), z},
                   -Eigen::Vector3f::UnitZ()};
    const auto hit = scene.cast(down, z - low + kAboveM, RayScene::Layer::kSolid);
    if (!hit) break;
    const float surface = z - hit->distance_m;
    if (above - surface >= static_cast<float>(vehicle.height_m)) floor = surface;
    above = surface;
    z = surface - kBehindSurfaceM;
  }
  return floor;
}

Sinkage sinkage_at(const World& world, const Eigen::Vector2d& p_world) {
  Sinkage deepest;
  for (const SoftGround& ground : world.soft_ground) {
    const double r2 = (p_world - ground.p_world).squaredNorm();
    const double u = 1.0 - r2 / (ground.radius_m * ground.radius_m);
    if (u <= 0.0) continue;
    const double depth_m = ground.depth_m * u * u;
    if (depth_m > deepest.depth_m) deepest = {depth_m, ground.name};
  }
  return deepest;
}

std::optional<WaterAbove> water_above(const World& world, const Eigen::Vector3d& p_world) {
  std::optional<WaterAbove> deepest;
  for (const StandingWater& water : world.water) {
    const double depth_m = water.level_m - p_world.z();
    if (depth_m <= (deepest ? deepest->depth_m : 0.0)) continue;
    if (encloses(water.outline, p_world.head<2>())) deepest = WaterAbove{depth_m, water.name};
  }
  return deepest;
}

}  // namespace adit
