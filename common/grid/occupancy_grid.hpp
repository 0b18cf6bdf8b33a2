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
  double range_max_m = 30.0;    ///< longer readings and no-returns are ignored
  int cells_max = 100'000'000;  ///< the map does not grow beyond this; a cell takes 8 bytes

  template <class V>
  void visit(V& v) {
    v("resolution_m", resolution_m, within(0.005, 1.0));
    v("range_min_m", range_min_m, at_least(0.0));
    v("range_max_m", range_max_m, above(0.0));
    v("cells_max", cells_max, at_least(1));
  }
};

enum class CellState : std::uint8_t { kUnknown, kFree, kOccupied };

/// A planar map of counts: the number of scans that observed each cell as reflecting (hits) and as
/// transparent (misses); their ratio is the maximum-likelihood reflection probability (Hähnel et
/// al. 2003). A scan counts once per cell, and a cell hit in a scan is not missed by its other
/// beams. The map grows with the scans; cells keep their coordinates.
class OccupancyGrid {
 public:
  explicit OccupancyGrid(const OccupancyGridParams& params) : params_(params) {}

  /// Inserts a scan. Returns false and inserts nothing if the pose is not finite or the map would
  /// exceed its maximum size, which only an erroneous pose causes.
  [[nodiscard]] bool insert(const LaserScan& scan, const Pose2& T_map_laser);

  [[nodiscard]] CellState state(const Eigen::Vector2i& cell) const;
  /// Share of hits among hits and misses, 0 to 1; 0 where the cell is unknown.
  [[nodiscard]] double occupancy(const Eigen::Vector2i& cell) const;
  /// Scans that observed a cell as reflecting and as transparent.
  struct Counts {
    std::uint16_t hits = 0;
    std::uint16_t misses = 0;
  };
  [[nodiscard]] Counts counts(const Eigen::Vector2i& cell) const;
  /// The share of hits from which a cell is occupied: poses err by more than a cell, so walls are
  /// partly transparent.
  static constexpr double kOccupiedShare = 0.3;
  /// The smallest box around all observed cells; empty if there is none.
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
  void count_misses(const Eigen::Vector2d& from, const Eigen::Vector2d& to);
  [[nodiscard]] const Cell* find(const Eigen::Vector2i& cell) const;

  OccupancyGridParams params_;
  Grid2<Cell> cells_;
  std::uint32_t scan_ = 0;
};

/// Writes `stem`.pgm and `stem`.yaml to a folder, in the format of ROS map_server and Nav2:
/// trinary, highest row first, origin at the lower left corner of the lowest cell, with a margin of
/// one unknown cell around the map. The same map gives the same bytes. Throws std::runtime_error if
/// a file cannot be written.
void write_map_server(const OccupancyGrid& grid, const std::filesystem::path& folder,
                      const std::string& stem);

}  // namespace adit
