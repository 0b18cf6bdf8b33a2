// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/loose_things.hpp"

namespace adit {
namespace {

constexpr int kCablePieces = 60;

void join(TriangleMesh& mesh, const TriangleMesh& more) {
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

void add_things(World& world, const AddThings& add) {
  MeshBuilder builder;
  add(builder, world);
  join(world.mesh, builder.take());
}

void add_cable(MeshBuilder& builder, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
               double sag_m, double diameter_m) {
  std::vector<Eigen::Vector3d> line;
  for (int i = 0; i <= kCablePieces; ++i) {
    const double share = static_cast<double>(i) / kCablePieces;
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

}  // namespace adit
