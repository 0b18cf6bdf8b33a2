// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "procs/terrain/terrain.hpp"
#include "sim/mesh/mesh_builder.hpp"

namespace adit {

/// A vehicle that drives and looks in what is built anew for each look, by its terrain stage. It
/// drives straight, in pieces of 5 cm, 0.4 m/s.
class LookingVehicle {
 public:
  using Build = std::function<void(MeshBuilder&)>;

  explicit LookingVehicle(const Pose2& T_world_body, const TerrainParams& params = {})
      : terrain_(params), memory_(params), T_world_body_(T_world_body) {
    memory_.add(utime_, T_world_body_);
  }

  void drive_to(const Pose2& T_world_body);
  /// `floor_m`: z of the ground in world where it stands. `T_odom_world` is what odom gets wrong.
  TerrainMap look(const Build& build, bool rear = false, double floor_m = 0.0,
                  const Pose2& T_odom_world = {});

  [[nodiscard]] TerrainMemory& memory() { return memory_; }

 private:
  Terrain terrain_;
  TerrainMemory memory_;
  Pose2 T_world_body_;
  std::int64_t utime_ = 1'600'000'000'000'000;
};

}  // namespace adit
