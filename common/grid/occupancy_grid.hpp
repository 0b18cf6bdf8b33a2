// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"
#include "common/grid/grid2.hpp"
#include "common/sensing/laser_scan.hpp"

namespace adit {

struct OccupancyGridParams {
  double resolution_m = 0.05;   ///< side of a cell
  double range_min_m = 0.1;     ///< shorter readings are dirt or the vehicle itself
  double range_max_m = 30.0;    ///< longer readings are left out, "no return" with them
  int cells_max = 100'000'000;  ///< refuse to grow beyond this; a cell takes 8 bytes

  template <class V>
  void visit(V& v) {
    v("resolution_m", resolution_m, within(0.005, 1.0));
    v("range_min_m", range_min_m, at_least(0.0));
    v("range_max_m", range_max_m, above(0.0));
    v("cells_max", cells_max, at_least(1));
  }
};

enum class CellState : std::uint8_t { kUnknown, kFree, kOccupied };

/// A plane map of counts: how many scans saw each cell reflect (hits) and how many saw through it
/// (misses); their ratio is the maximum-likelihood reflection probability (Hähnel et al. 2003). A
/// scan counts once per cell, and a cell that reflects in a scan is not missed by its other beams.
/// The map grows as scans come in; cells keep their coordinates.
class OccupancyGrid {
 public:
  explicit OccupancyGrid(const OccupancyGridParams& params) : params_(params) {}

  /// Enters a scan. False, and nothing is entered, where the pose is not finite or the map would
  /// become larger than allowed: a pose that far away is an error of somebody's.
  [[nodiscard]] bool insert(const LaserScan& scan, const Pose2& T_map_laser);

  [[nodiscard]] CellState state(const Eigen::Vector2i& cell) const;
  /// Share of hits among hits and misses, 0 to 1; 0 where the cell is unknown.
  [[nodiscard]] double occupancy(const Eigen::Vector2i& cell) const;
  /// The smallest box around all cells that are known; empty if none is.
  [[nodiscard]] CellBox observed_box() const;

  [[nodiscard]] double resolution_m() const { return params_.resolution_m; }
  [[nodiscard]] Eigen::Vector2i cell_at(const Eigen::Vector2d& p_map) const;

 private:
  struct Cell {
    std::uint16_t hits = 0;
    std::uint16_t misses = 0;
    std::uint32_t last_scan = 0;
  };

  [[nodiscard]] std::vector<Eigen::Vector2d> end_points(const LaserScan& scan,
                                                        const Pose2& T_map_laser) const;
  [[nodiscard]] bool reserve(const CellBox& box);
  void carve(const Eigen::Vector2d& from, const Eigen::Vector2d& to);
  [[nodiscard]] Cell& at(const Eigen::Vector2i& cell);
  [[nodiscard]] const Cell* find(const Eigen::Vector2i& cell) const;

  OccupancyGridParams params_;
  CellBox box_;              // of the cells that are stored
  std::vector<Cell> cells_;  // row by row, from the lowest
  std::uint32_t scan_ = 0;
};

/// Writes `stem`.pgm and `stem`.yaml into a folder, as ROS's map_server and nav2 read them:
/// trinary, the highest row first, origin at the lower left corner of the lowest cell. The margin
/// keeps one unknown cell around the map. The same map gives the same bytes. Throws
/// std::runtime_error where a file cannot be written.
void write_map_server(const OccupancyGrid& grid, const std::filesystem::path& folder,
                      const std::string& stem);

}  // namespace adit
