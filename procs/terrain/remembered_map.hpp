// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "common/terrain/terrain_map.hpp"
#include "common/vehicle/vehicle.hpp"
#include "procs/terrain/cell_heights.hpp"

namespace adit {

/// What a pose does, with its sine and cosine taken once.
inline Eigen::Isometry2d motion_of(const Pose2& T_a_b) {
  return Eigen::Translation2d(T_a_b.x, T_a_b.y) * Eigen::Rotation2Dd(T_a_b.theta);
}

/// From which height above the ground on a cell shows an obstacle, and not rough ground [m].
inline float obstacle_height_m(const Vehicle& vehicle) {
  return static_cast<float>(0.75 * vehicle.step_max_m);
}

/// Whether points of a look show an obstacle. For cells of terrain maps and remembered ones.
template <class Cell>
bool stands_out(const Cell& cell, float obstacle_m) {
  return cell.ground == Ground::kSeen && cell.count > 0 && cell.high_m - cell.low_m > obstacle_m;
}

inline bool is_unknown(const TerrainCell& cell) {
  return cell.ground == Ground::kNeverSeen || cell.ground == Ground::kShadow;
}

/// What one look said of a cell. Heights are z in the level of that look [m].
struct RememberedCell {
  float low_m = 0.0F;
  float high_m = 0.0F;
  float roof_m = 0.0F;  ///< infinite where none was seen
  std::uint16_t count = 0;
  Ground ground = Ground::kNeverSeen;
  bool barred = false;  ///< unknown since something has changed there: nothing older is to be asked

  /// Whether it says anything of the ground.
  [[nodiscard]] bool says() const {
    return barred || (ground != Ground::kNeverSeen && ground != Ground::kShadow);
  }
};

/// The heights of one look alone, nothing in it from before. Its cells are those of the map; narrow
/// gaps between its beams say nothing.
class RememberedMap {
 public:
  /// Of a map of which `clearance_m` still is the height of the roof.
  RememberedMap(const TerrainMap& map, double way_m);

  /// The cell around a place in its level, or nothing where it has none.
  [[nodiscard]] const RememberedCell* at(float x, float y) const {
    const int cell = finder_.at(x, y);
    return cell == CellFinder::kOutside ? nullptr : &cells_[static_cast<std::size_t>(cell)];
  }
  [[nodiscard]] RememberedCell& cell(std::size_t i) { return cells_[i]; }
  [[nodiscard]] const Pose2& T_odom_level() const { return T_odom_level_; }
  [[nodiscard]] double way_m() const { return way_m_; }  ///< driven until then
  /// Odom has begun anew; the one of before lies there.
  void tie(const Pose2& T_odom_before) { T_odom_level_ = T_odom_before * T_odom_level_; }

 private:
  CellFinder finder_;
  Pose2 T_odom_level_;
  double way_m_;
  std::vector<RememberedCell> cells_;
};

}  // namespace adit
