// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "common/grid/grid2.hpp"

namespace adit {

/// Knowledge about the ground of a cell.
enum class Ground : std::uint8_t {
  kObserved,
  kNeverObserved,  ///< no beam was aimed at it
  kOccluded,       ///< hidden behind a nearer obstacle
  kBelowRay,       ///< beams passed over it without a return: the ground is below `low_m`
  kNoReturn,       ///< beams that should have hit the ground had no return: possibly water
};

/// One cell of a terrain map. Heights are z in level [m]; unknown heights are NaN.
struct TerrainCell {
  Ground ground = Ground::kNeverObserved;
  std::uint16_t count =
      0;                ///< number of points; 0 if interpolated between beams that hit the ground
  float low_m = 0.0F;   ///< height of the ground
  float high_m = 0.0F;  ///< highest point within the vehicle's height above `low_m`
  float coefficient_m =
      0.0F;  ///< navigational coefficient, high_m − low_m: difficulty of traversal
  /// From `low_m` to the roof; infinite without a roof; NaN if something nearer hides whether there
  /// is one within the height of the vehicle.
  float clearance_m = 0.0F;
  float slope_rad = 0.0F;    ///< slope of a plane fitted to the surrounding ground
  float step_m = 0.0F;       ///< largest ground difference to a neighbouring cell
  float repulsion_m = 0.0F;  ///< surrounding coefficients weighted by a kernel that repels paths
  std::uint16_t obstacle_parts = 0;  ///< CellParts in which points show an obstacle
};

/// The 4 × 4 equal parts of a cell, as bits: where in a cell an obstacle stands. A region of 3 × 3
/// cells decides that there is one; its parts say where its points lie.
struct CellParts {
  static constexpr int kSide = 4;
  static constexpr int kCount = kSide * kSide;

  /// The bit of the part at (x, y), each from 0 to 1 across the cell.
  [[nodiscard]] static std::uint16_t bit_at(double x, double y) {
    const auto part = [](double share) {
      return std::clamp(static_cast<int>(kSide * share), 0, kSide - 1);
    };
    return static_cast<std::uint16_t>(1U << static_cast<unsigned>(kSide * part(y) + part(x)));
  }
  /// The centre of a part, from 0 to 1 across the cell.
  [[nodiscard]] static Eigen::Vector2d centre(int part) {
    const int row = part / kSide;
    return Eigen::Vector2d(part % kSide + 0.5, row + 0.5) / kSide;
  }
};

/// The 2½D terrain map of a 3D scan (the paper's section 3.1), in the frame level of its cloud.
/// Cell (column, row) covers [column, column + 1) × [row, row + 1) times `cell_m` from
/// `p_level_corner`, which is the corner of cell (0, 0), the first one.
struct TerrainMap {
  std::int64_t utime = 0;  ///< time of the cloud [µs since the epoch]
  std::int32_t id = 0;     ///< id of the cloud
  Pose2 T_odom_level;
  Eigen::Vector2d p_level_corner{0.0, 0.0};  ///< [m]
  double cell_m = 0.1;
  Grid2<TerrainCell> cells;  ///< from (0, 0)

  /// p_level of the centre of a cell [m].
  [[nodiscard]] Eigen::Vector2d centre(int column, int row) const {
    return p_level_corner + cell_m * Eigen::Vector2d(column + 0.5, row + 0.5);
  }
  /// The cell that contains a point, which may lie outside the map.
  [[nodiscard]] Eigen::Vector2i cell_at(const Eigen::Vector2d& p_level) const {
    return cell_of(p_level - p_level_corner, cell_m);
  }
  /// Heights of the observed ground; NaN where none is observed [m].
  [[nodiscard]] Grid2<float> ground_m() const {
    Grid2<float> heights_m(cells.box(), std::numeric_limits<float>::quiet_NaN());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (cells[i].ground == Ground::kObserved) heights_m[i] = cells[i].low_m;
    }
    return heights_m;
  }
};

/// A terrain map of a 3D scan is complete and all its fragments have been sent.
struct TerrainReady {
  std::int64_t utime = 0;  ///< TerrainMap::utime [µs since the epoch]
  std::int32_t id = 0;     ///< Cloud::id
  bool complete = true;    ///< Cloud::complete

  friend bool operator==(const TerrainReady&, const TerrainReady&) = default;
};

}  // namespace adit
