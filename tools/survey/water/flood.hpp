// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/grid/grid2.hpp"

namespace adit {

/// The floor of a mine by cells, for what water does on it.
struct FloodGround {
  double cell_m = 0.1;
  Grid2<float> floor_m;         ///< height; NaN: rock, or nothing is known
  Grid2<std::uint8_t> outlets;  ///< 1 where the floor continues beyond what was seen
};

/// Where water leaves a body.
struct Spill {
  double level_m = 0.0;             ///< of the water when it does
  Eigen::Vector2d place{0.0, 0.0};  ///< of the pass over which it runs
  bool out_of_sight = false;        ///< to where nothing was seen; otherwise to lower ground
};

/// Standing water on connected floor.
struct WaterBody {
  double level_m = 0.0;
  double area_m2 = 0.0;
  double volume_m3 = 0.0;
  double depth_m = 0.0;               ///< the largest one
  Eigen::Vector2d deepest{0.0, 0.0};  ///< its place
  bool reaches_unseen = false;        ///< it continues where nothing was seen
  std::optional<Spill> spill;         ///< nothing: no outlet was seen
  std::vector<Eigen::Vector2i> cells;

  [[nodiscard]] double mean_depth_m() const { return volume_m3 / area_m2; }
};

/// The bodies of water at a level, as if it came up through the floor: connected cells whose floor
/// is lower, and over which pass each would run if it rose. Those of less than `area_min_m2` are
/// left out. Largest volume first.
std::vector<WaterBody> flooded_at(const FloodGround& ground, double level_m, double area_min_m2);

struct HollowParams {
  double depth_min_m = 0.1;
  double area_min_m2 = 1.0;
};

/// Hollows of the floor, filled to where they spill (priority flood: Barnes, Lehman, Mulla,
/// "Priority-flood: an optimal depression-filling and watershed-labeling algorithm for digital
/// elevation models", Computers & Geosciences 62, 2014, algorithm 1, from the outlets). Floor from
/// which no outlet is reached has no level to which it fills, and no hollows. Largest volume first.
std::vector<WaterBody> hollows(const FloodGround& ground, const HollowParams& params = {});

}  // namespace adit
