// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/types/planned_path.hpp"
#include "common/types/terrain_map.hpp"
#include "common/types/vehicle.hpp"

namespace adit {

/// What ground is refused, beyond what the shape of the vehicle says, and what it costs.
struct GroundLimits {
  double step_margin_m = 0.03;       ///< below Vehicle::step_max_m that a wheel is led over
  double belly_margin_m = 0.03;      ///< below Vehicle::belly_clearance_m
  double roof_margin_m = 0.15;       ///< above Vehicle::height_m: a wheel on a rail lifts a corner
  double slope_max_rad = 0.35;       ///< of ground under the wheels
  double unknown_roughness = 0.5;    ///< of ground that was not seen, 0 (even) to 1 (at the limit)
  double blind_beside_m = 0.4;       ///< the robot, unseen: its tail swings by 0.3 m at most
  double blind_ahead_m = 1.2;        ///< likewise before an end of it
  double blind_margin_m = 0.8;       ///< to either side of that, beyond its width
  double repulsion_roughness = 0.4;  ///< of even ground that repels as a step at the limit does

  template <class V>
  void visit(V& v) {
    v("step_margin_m", step_margin_m, at_least(0.0));
    v("belly_margin_m", belly_margin_m, at_least(0.0));
    v("roof_margin_m", roof_margin_m, at_least(0.0));
    v("slope_max_rad", slope_max_rad, above(0.0));
    v("unknown_roughness", unknown_roughness, within(0.0, 1.0));
    v("blind_beside_m", blind_beside_m, at_least(0.0));
    v("blind_ahead_m", blind_ahead_m, at_least(0.0));
    v("blind_margin_m", blind_margin_m, at_least(0.0));
    v("repulsion_roughness", repulsion_roughness, within(0.0, 1.0));
  }
};

/// What the cells of a terrain map mean to a vehicle, cell by cell in the order of the map.
struct GroundLayers {
  int columns = 0;
  int rows = 0;
  double cell_m = 0.1;
  std::vector<std::uint8_t> under_body;    ///< 1: lethal anywhere under the vehicle
  std::vector<std::uint8_t> under_wheels;  ///< 1: lethal under the wheels
  std::vector<std::uint8_t> unknown;       ///< 1: not known whether it carries
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
