// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/worlds/box_tunnel.hpp"

#include <cmath>

namespace adit {
namespace {

std::uint32_t corner(MeshBuilder& builder, double x, double y, double z) {
  return builder.vertex(Eigen::Vector3d(x, y, z).cast<float>());
}

}  // namespace

World box_tunnel(const BoxTunnel& tunnel, const std::function<void(MeshBuilder&)>& add) {
  const double x = tunnel.length_m / 2.0;
  const double y = tunnel.width_m / 2.0;
  const double z = tunnel.height_m;
  MeshBuilder builder;
  const std::array<std::uint32_t, 4> floor{corner(builder, -x, -y, 0.0),
                                           corner(builder, x, -y, 0.0), corner(builder, x, y, 0.0),
                                           corner(builder, -x, y, 0.0)};
  const std::array<std::uint32_t, 4> roof{corner(builder, -x, -y, z), corner(builder, x, -y, z),
                                          corner(builder, x, y, z), corner(builder, -x, y, z)};
  builder.begin_part(PartKind::kFloor, Material::kRock, "floor");
  builder.quad(floor[0], floor[1], floor[2], floor[3]);
  builder.begin_part(PartKind::kRoof, Material::kRock, "roof");
  builder.quad(roof[0], roof[1], roof[2], roof[3]);
  builder.begin_part(PartKind::kWall, Material::kRock, "walls");
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t j = (i + 1) % 4;
    builder.quad(floor[i], floor[j], roof[j], roof[i]);
  }
  add(builder);

  World world;
  world.name = "box_tunnel";
  world.mesh = builder.take();
  world.truth.plan = {{{{-x, -y}, {x, -y}, {x, y}, {-x, y}}}};
  world.truth.floor_height = [x, y](const Eigen::Vector2d& p) -> std::optional<double> {
    if (std::abs(p.x()) > x || std::abs(p.y()) > y) return std::nullopt;
    return 0.0;
  };
  return world;
}

OrientedBox level_box(const Eigen::Vector3d& middle, const Eigen::Vector3d& size) {
  OrientedBox box;
  box.T_world_box.translation() = middle;
  box.half_size = size / 2.0;
  return box;
}

}  // namespace adit
