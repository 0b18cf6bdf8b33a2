// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/procs/terrain/terrain_scenes.hpp"

#include <cmath>

#include "common/geometry/pose2.hpp"
#include "sim/sweep/tilt_sweep.hpp"

namespace adit {

Cloud cloud_of(const std::function<void(MeshBuilder&)>& add,
               const Eigen::Isometry3d& T_world_body) {
  MeshBuilder builder;
  builder.begin_part(PartKind::kFloor, Material::kRock, "rock");
  add(builder);
  World world;
  world.mesh = builder.take();
  return tilt_sweep(Site(std::move(world)), T_world_body);
}

void add_rock(MeshBuilder& builder, const Eigen::Vector3d& middle, const Eigen::Vector3d& size) {
  OrientedBox box;
  box.T_world_box.translation() = middle;
  box.half_size = size / 2.0;
  builder.box(box);
}

void add_ground(MeshBuilder& builder, double from_m, double to_m, double top_m) {
  add_rock(builder, {(from_m + to_m) / 2.0, 0.0, top_m - 2.0}, {to_m - from_m, 4.0, 4.0});
}

void add_tunnel(MeshBuilder& builder) {
  add_ground(builder, -15.0, 15.0);
  add_rock(builder, {0.0, 0.0, 2.5}, {30.0, 4.0, 1.0});
  for (const double side : {-1.0, 1.0}) {
    add_rock(builder, {0.0, side * 2.5, 1.0}, {30.0, 1.0, 4.0});
    add_rock(builder, {side * 15.5, 0.0, 1.0}, {1.0, 4.0, 4.0});
  }
}

const TerrainCell& cell_at(const TerrainMap& map, double x, double y) {
  return map.cells.at(map.cell_at({x, y}));
}

void for_cells(const TerrainMap& map, const Eigen::AlignedBox2d& box,
               const std::function<void(const TerrainCell&)>& visit) {
  for (int row = 0; row < map.cells.rows(); ++row) {
    for (int column = 0; column < map.cells.columns(); ++column) {
      if (box.contains(map.centre(column, row))) visit(map.cells.at({column, row}));
    }
  }
}

double share_of(const TerrainMap& map, const Eigen::AlignedBox2d& box,
                const std::function<bool(const TerrainCell&)>& is) {
  int cells = 0;
  int hits = 0;
  for_cells(map, box, [&](const TerrainCell& cell) {
    ++cells;
    hits += is(cell) ? 1 : 0;
  });
  return static_cast<double>(hits) / cells;
}

void ScanningVehicle::drive_to(const Pose2& T_world_body) {
  constexpr double kStepM = 0.05;
  const Pose2 from = T_world_body_;
  const Eigen::Vector2d offset = T_world_body.translation() - from.translation();
  const int steps = static_cast<int>(std::ceil(offset.norm() / kStepM));
  for (int i = 1; i <= steps; ++i) {
    const Eigen::Vector2d p = from.translation() + offset * i / steps;
    utime_ += 125'000;
    memory_.add(utime_, {p.x(), p.y(), T_world_body.theta});
  }
  T_world_body_ = T_world_body;
}

TerrainMap ScanningVehicle::scan(const Build& build, bool rear, double floor_m,
                                 const Pose2& T_odom_world) {
  MeshBuilder builder;
  builder.begin_part(PartKind::kFloor, Material::kRock, "rock");
  build(builder);
  World world;
  world.mesh = builder.take();
  TiltSweep sweep;
  if (rear) sweep.mount = groundhog_lasers().rear;
  Cloud cloud = tilt_sweep(Site(std::move(world)), in_space(T_world_body_, floor_m), sweep);
  utime_ += 10'000'000;
  cloud.utime = utime_;
  cloud.T_odom_level = T_odom_world * cloud.T_odom_level;
  return terrain_.make(cloud, memory_);
}

}  // namespace adit
