// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "common/types/terrain_map.hpp"
#include "common/types/vehicle.hpp"
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
bool is_obstacle(const Cell& cell, float obstacle_m) {
  return cell.ground == Ground::kObserved && cell.count > 0 &&
         cell.high_m - cell.low_m > obstacle_m;
}

inline bool is_unknown(const TerrainCell& cell) {
  return cell.ground == Ground::kNeverObserved || cell.ground == Ground::kOccluded;
}

/// What one look said of a cell. Heights are z in the level of that look [m].
struct RememberedCell {
  float low_m = 0.0F;
  float high_m = 0.0F;
  float roof_m = 0.0F;  ///< infinite where none was seen
  std::uint16_t count = 0;
  Ground ground = Ground::kNeverObserved;
  bool invalidated =
      false;  ///< unknown since something has changed there: nothing older is to be asked

  /// Whether it says anything of the ground.
  [[nodiscard]] bool is_informative() const {
    return invalidated || (ground != Ground::kNeverObserved && ground != Ground::kOccluded);
  }
};

/// The heights of one look alone, nothing in it from before. Its cells are those of the map; narrow
/// gaps between its beams say nothing.
class RememberedMap {
 public:
  /// Of a map of which `clearance_m` still is the height of the roof.
  RememberedMap(const TerrainMap& map, double distance_travelled_m);

  /// The cell around a place in its level, or nothing where it has none.
  [[nodiscard]] const RememberedCell* at(float x, float y) const {
    const int cell = finder_.at(x, y);
    return cell == CellFinder::kOutside ? nullptr : &cells_[static_cast<std::size_t>(cell)];
  }
  [[nodiscard]] RememberedCell& cell(std::size_t i) { return cells_[i]; }
  [[nodiscard]] const Pose2& T_odom_level() const { return T_odom_level_; }
  [[nodiscard]] double distance_travelled_m() const {
    return distance_travelled_m_;
  }  ///< driven until then
  /// Odom has begun anew; the one of before lies there.
  void anchor(const Pose2& T_odom_previous) { T_odom_level_ = T_odom_previous * T_odom_level_; }

 private:
  CellFinder finder_;
  Pose2 T_odom_level_;
  double distance_travelled_m_;
  std::vector<RememberedCell> cells_;
};

/// Whether beams passed over a cell, but over few around it: from afar they are spread so far that
/// even ground has such gaps. No wheel falls into them. Drops are wider.
bool is_narrow_gap(const TerrainMap& map, int column, int row);

/// Takes for ground what is not known between cells with even ground: single cells and rows of
/// them, where `changed` is 0. Regions of the terrain bridge as much.
void close_narrow_gaps(TerrainMap& map, const std::vector<std::uint8_t>& changed, float obstacle_m);

}  // namespace adit
