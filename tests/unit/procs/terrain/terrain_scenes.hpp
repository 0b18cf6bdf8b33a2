// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "common/types/cloud.hpp"
#include "common/types/terrain_map.hpp"
#include "procs/terrain/terrain.hpp"
#include "sim/mesh/mesh_builder.hpp"

namespace adit {

/// The scan of a vehicle at the origin facing along x, in the world that `add` builds. The floor
/// below it is z = 0; `T_world_body` may tilt the vehicle.
Cloud cloud_of(const std::function<void(MeshBuilder&)>& add,
               const Eigen::Isometry3d& T_world_body = Eigen::Isometry3d::Identity());

/// Ground from x = `from_m` to `to_m`, 4 m wide, with its upper side at z = `top_m`.
void add_ground(MeshBuilder& builder, double from_m, double to_m, double top_m = 0.0);
/// A tunnel 30 m long, 4 m wide and 2 m high with the vehicle in its middle.
void add_tunnel(MeshBuilder& builder);
void add_rock(MeshBuilder& builder, const Eigen::Vector3d& middle, const Eigen::Vector3d& size);

/// The cell at a point in level [m].
const TerrainCell& cell_at(const TerrainMap& map, double x, double y);

/// Visits all cells whose centre is within a rectangle in level [m].
void for_cells(const TerrainMap& map, const Eigen::AlignedBox2d& box,
               const std::function<void(const TerrainCell&)>& visit);
/// Share of these cells for which a condition holds.
double share_of(const TerrainMap& map, const Eigen::AlignedBox2d& box,
                const std::function<bool(const TerrainCell&)>& is);

/// A vehicle that drives and scans, in a world built for each scan, with its terrain stage. It
/// drives straight, in steps of 5 cm, at 0.4 m/s.
class ScanningVehicle {
 public:
  using Build = std::function<void(MeshBuilder&)>;

  explicit ScanningVehicle(const Pose2& T_world_body, const TerrainParams& params = {})
      : terrain_(params), memory_(params), T_world_body_(T_world_body) {
    memory_.add(utime_, T_world_body_);
  }

  void drive_to(const Pose2& T_world_body);
  /// `floor_m`: z of the ground in world below the vehicle. `T_odom_world`: error of odom.
  TerrainMap scan(const Build& build, bool rear = false, double floor_m = 0.0,
                  const Pose2& T_odom_world = {});

  [[nodiscard]] TerrainMemory& memory() { return memory_; }

 private:
  Terrain terrain_;
  TerrainMemory memory_;
  Pose2 T_world_body_;
  std::int64_t utime_ = 1'600'000'000'000'000;
};

}  // namespace adit
