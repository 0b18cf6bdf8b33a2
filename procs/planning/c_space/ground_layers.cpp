// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/c_space/ground_layers.hpp"

#include <algorithm>
#include <cmath>

#include "common/grid/distance_transform.hpp"
#include "common/types/body_outline.hpp"
#include "procs/planning/c_space/leaning_obstacles.hpp"
#include "procs/planning/c_space/unobserved_ground.hpp"

namespace adit {
namespace {

using Reason = BlockingCell::Reason;

constexpr double kRoughnessMax = 255.0;  // stored value of roughness 1

bool blocks_body(Reason reason) { return reason == Reason::kBelly || reason == Reason::kRoof; }

/// Roughness of traversable ground, 0 to 1, by its step or its slope.
double roughness_share(const TerrainCell& cell, const Vehicle& vehicle,
                       const GroundLimits& limits) {
  const double share = std::max(cell.coefficient_m / (vehicle.step_max_m - limits.step_margin_m),
                                cell.slope_rad / limits.slope_max_rad / 2.0);
  return std::clamp(share, 0.0, 1.0);
}

void classify(GroundLayers& layers, std::size_t i, std::optional<Reason> reason) {
  if (!reason) return;
  if (*reason == Reason::kUnknown) {
    layers.unknown[i] = 1;
  } else {
    layers.under_wheels[i] = 1;
    layers.under_body[i] = blocks_body(*reason) ? 1 : 0;
  }
}

using GroundPredicate = bool (*)(Ground);

bool is_drop(Ground ground) { return ground == Ground::kBelowRay || ground == Ground::kNoReturn; }
bool is_shadow(Ground ground) { return ground == Ground::kOccluded; }

/// Whether a region is about three cells wide at a cell: three of the four neighbours belong to it.
/// A wheel may not bridge such a drop, and a post may stand in such a shadow.
bool is_wide(const TerrainMap& terrain, int column, int row, GroundPredicate is_member) {
  int around = 0;
  const auto count = [&](int c, int r) {
    if (terrain.cells.contains({c, r}) && is_member(terrain.cells.at({c, r}).ground)) ++around;
  };
  for (const int step : {-1, 1}) {
    count(column + step, row);
    count(column, row + step);
  }
  return around >= 3;
}

/// Marks the cells around the members of a region: `wide` cells around wide parts of it, `narrow`
/// cells around the others. The edge of a drop, of water or of a shadow is not measured: the region
/// begins up to a cell beyond the last points of the ground, which lie anywhere in their cell.
void dilate(CellLayer& layer, const TerrainMap& terrain, GroundPredicate is_member, int narrow,
            int wide) {
  const auto mark_around = [&](int column, int row, int reach) {
    for (int dy = -reach; dy <= reach; ++dy) {
      for (int dx = -reach; dx <= reach; ++dx) {
        if (!terrain.cells.contains({column + dx, row + dy})) continue;
        if (dx * dx + dy * dy > reach * reach) continue;
        layer.at({column + dx, row + dy}) = 1;
      }
    }
  };
  for (int row = 0; row < terrain.cells.rows(); ++row) {
    for (int column = 0; column < terrain.cells.columns(); ++column) {
      if (!is_member(terrain.cells.at({column, row}).ground)) continue;
      const int reach = is_wide(terrain, column, row, is_member) ? wide : narrow;
      if (reach > 0) mark_around(column, row, reach);
    }
  }
}

/// Height above the ground up to which an obstacle of a cell can touch the body: of a wall its top,
/// of a roof its underside [m].
double contact_height_m(const TerrainCell& cell, Reason reason) {
  return reason == Reason::kRoof ? cell.clearance_m : cell.coefficient_m;
}

/// Marks the cells over which the obstacle of a cell leans.
void mark_below(GroundLayers& layers, const TerrainMap& terrain, const Eigen::Vector2i& at) {
  const Eigen::Vector2d& displacement_m = layers.displacement_m.at(at);
  const int steps = static_cast<int>(std::ceil(2.0 * displacement_m.norm() / terrain.cell_m));
  for (int step = 1; step <= steps; ++step) {
    const Eigen::Vector2i over =
        terrain.cell_at(terrain.centre(at.x(), at.y()) + displacement_m * step / steps);
    if (!terrain.cells.contains(over) || layers.under_body.at(over) != 0) continue;
    layers.under_body.at(over) = 1;
    layers.leaning_from.at(over) = static_cast<std::uint32_t>(terrain.cells.index(at) + 1);
  }
}

void mark_leaning(GroundLayers& layers, const TerrainMap& terrain) {
  for (int row = 0; row < terrain.cells.rows(); ++row) {
    for (int column = 0; column < terrain.cells.columns(); ++column) {
      mark_below(layers, terrain, {column, row});
    }
  }
}

/// Clears the cells under the robot: it stands there, so they are traversable.
void clear_footprint(GroundLayers& layers, const TerrainMap& terrain, const Pose2& T_level_body,
                     const ConvexPolygon& footprint) {
  const Pose2 T_body_level = T_level_body.inverse();
  for (int row = 0; row < terrain.cells.rows(); ++row) {
    for (int column = 0; column < terrain.cells.columns(); ++column) {
      if (!footprint.contains(T_body_level * terrain.centre(column, row))) continue;
      const std::size_t i = layers.index(column, row);
      layers.under_body[i] = layers.under_wheels[i] = layers.unknown[i] = 0;
      layers.leaning_from[i] = 0;
    }
  }
}

double roughness_of(const TerrainCell& cell, std::optional<Reason> reason, bool assumed_even,
                    const Vehicle& vehicle, const GroundLimits& limits) {
  if (reason == Reason::kUnknown) return assumed_even ? 0.0 : limits.unknown_roughness;
  return reason ? 1.0 : roughness_share(cell, vehicle, limits);
}

/// Roughness that obstacles around a cell add, by the repulsion kernel of the terrain map
/// (section 3.1 of the paper).
double repulsion(const TerrainCell& cell, const Vehicle& vehicle, const GroundLimits& limits) {
  const double step_m = vehicle.step_max_m - limits.step_margin_m;
  return limits.repulsion_roughness *
         std::clamp(std::fmax(cell.repulsion_m, 0.0) / step_m, 0.0, 1.0);
}

}  // namespace

std::optional<Reason> lethal_reason(const TerrainCell& cell, const Vehicle& vehicle,
                                    const GroundLimits& limits) {
  switch (cell.ground) {
    case Ground::kNeverObserved:
    case Ground::kOccluded:
      return Reason::kUnknown;
    case Ground::kBelowRay:
      return Reason::kDrop;
    case Ground::kNoReturn:
      return Reason::kWater;
    case Ground::kObserved:
      break;
  }
  if (std::isnan(cell.coefficient_m)) return Reason::kUnknown;
  // The belly comes before the roof: a wall extends above the vehicle and must not count as a roof.
  if (cell.coefficient_m > vehicle.belly_clearance_m - limits.belly_margin_m) return Reason::kBelly;
  if (std::isnan(cell.clearance_m)) return Reason::kUnknown;
  if (cell.clearance_m < vehicle.height_m + limits.roof_margin_m) return Reason::kRoof;
  const double step = std::fmax(cell.coefficient_m, cell.step_m);  // fmax ignores one NaN
  if (step > vehicle.step_max_m - limits.step_margin_m) return Reason::kStep;
  if (cell.slope_rad > limits.slope_max_rad) return Reason::kSlope;
  return std::nullopt;
}

GroundLayers ground_layers(const TerrainMap& terrain, const Pose2& T_level_body,
                           const Vehicle& vehicle, const GroundLimits& limits) {
  GroundLayers layers(terrain.cells.columns(), terrain.cells.rows(), terrain.cell_m);
  const Pose2 T_body_level = T_level_body.inverse();
  const ConvexPolygon footprint = body_outline(vehicle);
  const BlindZone blind_zone(terrain, T_level_body, vehicle, limits);
  const LeaningObstacles leaning(terrain);
  for (int row = 0; row < terrain.cells.rows(); ++row) {
    for (int column = 0; column < terrain.cells.columns(); ++column) {
      const std::size_t i = layers.index(column, row);
      const TerrainCell& cell = terrain.cells[i];
      const auto reason = lethal_reason(cell, vehicle, limits);
      const Eigen::Vector2d p_level = terrain.centre(column, row);
      const bool under_robot = footprint.contains(T_body_level * p_level);
      const bool blind = reason == Reason::kUnknown && cell.ground != Ground::kObserved &&
                         blind_zone.contains(p_level);
      if (!blind) classify(layers, i, reason);
      // What hides the headroom is too low itself: the body must not be there.
      if (reason == Reason::kUnknown && cell.ground == Ground::kObserved) layers.under_body[i] = 1;
      if (reason && blocks_body(*reason)) {
        layers.displacement_m[i] =
            leaning.displacement_m(column, row, contact_height_m(cell, *reason));
      }
      const double rough = roughness_of(cell, reason, under_robot || blind, vehicle, limits) +
                           repulsion(cell, vehicle, limits);
      layers.roughness[i] =
          static_cast<std::uint8_t>(std::lround(kRoughnessMax * std::min(rough, 1.0)));
    }
  }
  mark_leaning(layers, terrain);
  dilate(layers.under_wheels, terrain, is_drop, 1, 3);
  dilate(layers.unknown, terrain, is_shadow, 0, 2);
  clear_footprint(layers, terrain, T_level_body, footprint);
  layers.body_distance_m = distance_transform(layers.under_body, layers.cell_m);
  layers.wheel_distance_m = distance_transform(layers.under_wheels, layers.cell_m);
  return layers;
}

}  // namespace adit
