// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/path/planned_path.hpp"
#include "common/terrain/terrain_map.hpp"
#include "common/vehicle/vehicle.hpp"
#include "procs/planning/ground_limits.hpp"

namespace adit {

/// What the cells of a terrain map mean to a vehicle, cell by cell in the order of the map.
struct GroundLayers {
  int columns = 0;
  int rows = 0;
  double cell_m = 0.1;
  std::vector<std::uint8_t> under_body;    ///< 1: lethal anywhere under the vehicle
  std::vector<std::uint8_t> under_wheels;  ///< 1: lethal under the wheels
  std::vector<std::uint8_t> unseen;        ///< 1: not known whether it carries
  std::vector<std::uint8_t> roughness;     ///< 0 (even) to 255 (at the limit)
  std::vector<float> body_distance_m;      ///< to the nearest cell of `under_body`
  std::vector<float> wheel_distance_m;     ///< to the nearest cell of `under_wheels`

  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
};

/// Where the robot stands, in level, nothing is lethal, for it does stand there; and unseen ground
/// around it, where its own lasers cannot look, is taken to be like the ground under it.
GroundLayers ground_layers(const TerrainMap& terrain, const Pose2& T_level_body,
                           const Vehicle& vehicle, const GroundLimits& limits);

/// Why a cell is lethal, or would be if all of a wheel stood on it; nothing if it is not.
std::optional<BlockingCell::Reason> lethal_reason(const TerrainCell& cell, const Vehicle& vehicle,
                                                  const GroundLimits& limits);

}  // namespace adit
