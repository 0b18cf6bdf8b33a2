// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/types/local_map.hpp"
#include "procs/mapping/loop_closure/local_walls.hpp"
#include "tests/support/worlds/wall_world.hpp"

namespace adit::test {

inline const std::string kFront = "LASER_FRONT";

inline LaserMounts front_mount() { return {{kFront, LaserMount{}}}; }

/// A local map of a straight path of `length_m`, a scan every 0.2 m, each at its true pose.
inline LocalMap drive_straight(const WallWorld& world, const Pose2& T_world_local, double length_m,
                               std::uint64_t seed) {
  LevelLaser laser(world, seed);
  LocalMap map;
  for (double x = 0.0; x <= length_m; x += 0.2) {
    const Pose2 T_local_body{x, 0.0, 0.0};
    map.scans.push_back(
        {kFront, laser.measure(T_world_local * T_local_body, 1'000'000), T_local_body});
  }
  return map;
}

inline LocalWalls walls_of(const WallWorld& world, const Pose2& T_world_local,
                           double length_m = 5.0, std::uint64_t seed = 1) {
  return local_walls(drive_straight(world, T_world_local, length_m, seed), front_mount(), {});
}

/// For a list of walls that does not own them.
inline std::shared_ptr<const LocalWalls> borrowed(const LocalWalls& walls) {
  return {std::shared_ptr<const LocalWalls>(), &walls};
}

}  // namespace adit::test
