// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/grid/grid2.hpp"
#include "common/types/planned_path.hpp"
#include "common/types/terrain_map.hpp"
#include "common/types/vehicle.hpp"

namespace adit {

/// Which ground is lethal, in addition to the dimensions of the vehicle, and how rough it counts.
/// Roughness is 0 for even ground and 1 for ground at the limit.
struct GroundLimits {
  double step_margin_m = 0.03;     ///< below Vehicle::step_max_m
  double belly_margin_m = 0.03;    ///< below Vehicle::belly_clearance_m
  double roof_margin_m = 0.15;     ///< above Vehicle::height_m; a wheel on a rail lifts a corner
  double slope_max_rad = 0.35;     ///< maximum slope under the wheels
  double unknown_roughness = 0.5;  ///< roughness of unobserved ground
  double blind_beside_m = 0.4;     ///< blind zone beside the body; the tail swings by 0.3 m at most
  double blind_ahead_m = 1.2;      ///< blind zone ahead of and behind the body
  double blind_margin_m = 0.8;     ///< width of that zone beyond the body, on each side
  double repulsion_roughness = 0.4;  ///< of even ground with the repulsion of a step at the limit

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

/// One value for each cell of a terrain map, in the order of the map.
using CellLayer = Grid2<std::uint8_t>;

/// The cells of a terrain map, classified for a vehicle. All layers have the size of the map.
struct GroundLayers {
  GroundLayers(int columns, int rows, double cell_size_m)
      : cell_m(cell_size_m),
        under_body(columns, rows),
        under_wheels(columns, rows),
        unknown(columns, rows),
        roughness(columns, rows),
        displacement_m(columns, rows, Eigen::Vector2d(0.0, 0.0)),
        leaning_from(columns, rows) {}

  double cell_m;
  CellLayer under_body;    ///< 1: lethal under any part of the vehicle
  CellLayer under_wheels;  ///< 1: lethal under the wheels
  CellLayer unknown;       ///< 1: unobserved ground
  CellLayer roughness;     ///< 0 (even) to 255 (at the limit)
  /// By which the obstacle in the cell leans over the ground (LeaningObstacles), at the height up
  /// to which it can touch the body, in level [m]; zero without one.
  Grid2<Eigen::Vector2d> displacement_m;
  /// Where an obstacle leans over the cell (LeaningObstacles): one more than the index of the cell
  /// in which it stands, otherwise 0.
  Grid2<std::uint32_t> leaning_from;
  Grid2<float> body_distance_m;   ///< to the nearest cell of `under_body` [m]
  Grid2<float> wheel_distance_m;  ///< to the nearest cell of `under_wheels` [m]

  [[nodiscard]] int columns() const { return under_body.columns(); }
  [[nodiscard]] int rows() const { return under_body.rows(); }
  [[nodiscard]] std::size_t index(int column, int row) const {
    return under_body.index({column, row});
  }
};

/// Classifies a terrain map (sections 3.1 and 3.2 of the paper). The cells under the footprint of
/// the robot, whose pose is in level, are never lethal, since the robot stands there; unobserved
/// ground in the blind zone of its lasers is assumed to be like the ground under it.
GroundLayers ground_layers(const TerrainMap& terrain, const Pose2& T_level_body,
                           const Vehicle& vehicle, const GroundLimits& limits);

/// Why a cell is lethal to the vehicle or to a wheel on it; nothing where it is traversable.
std::optional<BlockingCell::Reason> lethal_reason(const TerrainCell& cell, const Vehicle& vehicle,
                                                  const GroundLimits& limits);

}  // namespace adit
