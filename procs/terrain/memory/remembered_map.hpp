// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "common/grid/grid2.hpp"
#include "common/types/terrain_map.hpp"
#include "common/types/vehicle.hpp"
#include "procs/terrain/cell_heights.hpp"

namespace adit {

/// A pose as a transformation, with sine and cosine computed once.
Eigen::Isometry2d motion_of(const Pose2& T_a_b);

/// Height above the ground from which a cell is an obstacle and not rough ground [m].
inline float obstacle_height_m(const Vehicle& vehicle) {
  return static_cast<float>(0.75 * vehicle.step_max_m);
}

/// Whether points of a scan show an obstacle. For cells of terrain maps and remembered ones.
template <class Cell>
bool is_obstacle(const Cell& cell, float obstacle_m) {
  return cell.ground == Ground::kObserved && cell.count > 0 &&
         cell.high_m - cell.low_m > obstacle_m;
}

inline bool is_unknown(const TerrainCell& cell) {
  return cell.ground == Ground::kNeverObserved || cell.ground == Ground::kOccluded;
}

/// A cell as one scan observed it. Heights are z in the level of that scan [m].
struct RememberedCell {
  float low_m = 0.0F;
  float high_m = 0.0F;
  float roof_m = 0.0F;  ///< infinite if none was observed, NaN if it was hidden
  std::uint16_t count = 0;
  Ground ground = Ground::kNeverObserved;
  bool invalidated = false;          ///< changed since older scans, which no longer count here
  std::uint16_t obstacle_parts = 0;  ///< as in TerrainCell

  /// Whether it contributes to later maps.
  [[nodiscard]] bool is_informative() const {
    return invalidated || (ground != Ground::kNeverObserved && ground != Ground::kOccluded);
  }
};

/// The heights of a single scan, without recalled ones. Its cells are those of the map; narrow gaps
/// between its beams are dropped.
class RememberedMap {
 public:
  /// From a map whose `clearance_m` is still the height of the roof.
  RememberedMap(const TerrainMap& map, double distance_travelled_m);

  /// The cell at a point in its level, or nullptr outside.
  [[nodiscard]] const RememberedCell* at(float x, float y) const {
    const int cell = finder_.at(x, y);
    if (cell == CellFinder::kOutside) return nullptr;
    const Eigen::Vector2i at(cell % columns_, cell / columns_);
    return cells_.contains(at) ? &cells_.at(at) : nullptr;
  }
  /// Whether an obstacle stands in the part of a cell that contains a point in its level.
  [[nodiscard]] bool has_obstacle_at(const Eigen::Vector2d& p_level) const;
  /// The cell with an index of the map; valid until `crop`.
  [[nodiscard]] RememberedCell& cell(std::size_t i) { return cells_[i]; }
  /// Drops the rows and columns at the rim that have no information.
  void crop();
  [[nodiscard]] const Pose2& T_odom_level() const { return T_odom_level_; }
  /// Distance travelled when the scan was taken.
  [[nodiscard]] double distance_travelled_m() const { return distance_travelled_m_; }
  /// Transforms it from the previous odom frame to the current one.
  void anchor(const Pose2& T_odom_previous) { T_odom_level_ = T_odom_previous * T_odom_level_; }

 private:
  CellFinder finder_;
  Eigen::Vector2d p_level_corner_;
  double cell_m_;
  Pose2 T_odom_level_;
  double distance_travelled_m_;
  int columns_;  ///< of the map
  Grid2<RememberedCell> cells_;
};

/// Whether beams passed over a cell, but over few cells around it: at long range the beams are so
/// far apart that even ground has such gaps. No wheel falls into them; drops are wider.
bool is_narrow_gap(const TerrainMap& map, int column, int row);

/// Fills unknown single cells and rows of cells between even ground, unless `changed` is set. The
/// regions of the terrain map bridge gaps of the same width.
void close_narrow_gaps(TerrainMap& map, const std::vector<std::uint8_t>& changed, float obstacle_m);

}  // namespace adit
