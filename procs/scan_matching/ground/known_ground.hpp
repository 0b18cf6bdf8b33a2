// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <unordered_map>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "common/types/terrain_map.hpp"

namespace adit {

/// The ground and roof around the robot as far as they are known, in odom: the terrain maps of the
/// last 3D scans, and the ground on which the body drove. It tells returns from the ground or the
/// roof from those of walls, on rising ground ahead too.
class KnownGround {
 public:
  enum class Surface { kUnknown, kWall, kGround, kRoof };

  /// `z_odom_level_m`: height of the origin of the map's frame, `slope_level`: its rise along the
  /// axes of that frame [m/m].
  void add(TerrainMap terrain, double z_odom_level_m,
           const Eigen::Vector2d& slope_level = Eigen::Vector2d::Zero());
  /// The ground under the body.
  void add(const Eigen::Vector2d& p_odom, double z_odom_m);
  void clear();
  /// Whether a 3D scan showed ground that is not level with that under the body.
  [[nodiscard]] bool shows_slope() const { return shows_slope_; }

  /// What a beam that ends at this point hit; `range_m` bounds the error of its height.
  [[nodiscard]] Surface surface_at(const Eigen::Vector2d& p_odom, double z_odom_m,
                                   double range_m) const;

 private:
  struct PlacedTerrain {
    TerrainMap map;
    double z_m = 0.0;
    Eigen::Vector2d slope;
    Pose2 T_level_odom;
  };

  bool shows_slope_ = false;
  std::deque<PlacedTerrain> terrains_;                   ///< newest first
  std::unordered_map<std::uint64_t, float> driven_z_m_;  ///< by cell
};

}  // namespace adit
