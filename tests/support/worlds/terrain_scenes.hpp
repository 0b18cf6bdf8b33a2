// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "common/types/terrain_map.hpp"

namespace adit {

/// Observed, even ground without a roof: a square around the origin of level.
TerrainMap even_ground(double side_m = 20.0, double cell_m = 0.1);

/// A cell of an obstacle of that height, as the terrain stage describes it.
TerrainCell obstacle_cell(double height_m);
TerrainCell unmeasured_cell(Ground ground);
TerrainCell roofed_cell(double clearance_m);

/// Replaces the cells whose centre satisfies `inside(p_level)`.
void paint(TerrainMap& terrain, const TerrainCell& cell,
           const std::function<bool(const Eigen::Vector2d&)>& inside);
void paint_box(TerrainMap& terrain, const TerrainCell& cell, const Eigen::Vector2d& low,
               const Eigen::Vector2d& high);
void paint_disc(TerrainMap& terrain, const TerrainCell& cell, const Eigen::Vector2d& middle,
                double radius_m);

/// The terrain mirrored about the x axis, which must run through the centres of a row.
TerrainMap mirrored(const TerrainMap& terrain);

/// A corridor along an arc that starts at the origin along x and is straight behind it. Nothing is
/// observed behind its walls. A free lane winds from side to side.
struct CorridorScene {
  struct Post {
    double along_m;
    double left_m;
    double radius_m;
  };

  double curvature_1_m = 0.0;  ///< positive to the left
  double width_m = 4.0;
  double lane_swing_m = 0.0;  ///< amplitude of the lane about the centre line
  double lane_wave_m = 10.0;  ///< wavelength of the lane
  double lane_phase_rad = 0.0;
  std::vector<Post> posts;
  std::vector<Post> shadows;  ///< occluded patches of ground
  bool rails = false;
  double end_m = 20.0;  ///< position of the end wall

  /// A point of level in corridor coordinates: along and to the left of the centre line [m].
  [[nodiscard]] Eigen::Vector2d to_corridor(const Eigen::Vector2d& p_level) const;
  /// Offset of the lane to the left of the centre line [m].
  [[nodiscard]] double lane_m(double along_m) const;
};

/// A bent corridor with up to 14 posts, none within `lane_half_m` of the centre of the lane. The
/// radius of the lane is at least 3 m.
CorridorScene random_corridor(std::uint32_t seed, double lane_half_m = 1.0);

TerrainMap terrain_of(const CorridorScene& scene, double side_m = 20.0, double cell_m = 0.1);

}  // namespace adit
