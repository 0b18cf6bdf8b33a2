// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/types/local_map.hpp"

namespace adit {

struct LocalMapTileParams {
  double resolution_m = 0.2;     ///< side of a cell
  double range_max_m = 8.0;      ///< beams count up to this range
  double view_distance_m = 0.5;  ///< motion of the laser after which a scan is entered
  double view_angle_rad = 0.3;   ///< or rotation
  double wall_share = 0.15;      ///< least share of scans ending in a cell that makes it a wall
  double steep_range_m = 1.7;    ///< a return nearer than this comes from no ground that a vehicle
                                 ///< climbs: it rises to the laser over this distance

  template <class V>
  void visit(V& v) {
    v("resolution_m", resolution_m, within(0.05, 1.0));
    v("range_max_m", range_max_m, within(1.0, 100.0));
    v("view_distance_m", view_distance_m, at_least(0.0));
    v("view_angle_rad", view_angle_rad, at_least(0.0));
    v("wall_share", wall_share, within(0.0, 1.0));
    v("steep_range_m", steep_range_m, at_least(0.0));
  }
};

/// A cell with returns.
struct WallCell {
  Eigen::Vector2d p_local{0.0, 0.0};  ///< mean of the returns [m]
  bool steep = false;                 ///< too steep for ground: a return came from nearby
};

/// A view through an opening into open air: adjacent beams without return over an angle that the
/// far end of a tunnel, beyond the range of the laser, does not fill.
struct OpenAir {
  Eigen::Vector2d p{0.0, 0.0};          ///< of the laser [m]
  Eigen::Vector2d direction{1.0, 0.0};  ///< of the middle of these beams, a unit vector
};

/// The cells that a local map observed, in its frame: computed once, and posed as often as the
/// graph moves. All its scans are level, as mapping uses no others. A beam without return adds
/// no cells: it may have met water or open air.
struct LocalMapTile {
  int session = 0;
  std::int64_t end_utime = 0;
  std::vector<Eigen::Vector2i> free;  ///< cells traversed by beams, by row, then column
  std::vector<WallCell> walls;
  std::vector<Eigen::Vector2d> path;   ///< p_local of the body, in order of time [m]
  std::vector<OpenAir> open_air = {};  ///< relative to the local map
  std::vector<double> path_z_m = {};   ///< heights of `path` above the origin of the local map
  std::vector<Eigen::Vector3d> footprint = {};  ///< MapFootprint::points, relative to the local map

  [[nodiscard]] bool is_free(const Eigen::Vector2i& cell_local) const;
};

/// Empty if the local map is malformed: without scans, or with a pose or an angle that is not
/// finite or too far away. Scans of channels other than LASER_FRONT and LASER_REAR are ignored.
std::optional<LocalMapTile> make_local_map_tile(const LocalMap& map, const Lasers& lasers,
                                                const LocalMapTileParams& params);

}  // namespace adit
