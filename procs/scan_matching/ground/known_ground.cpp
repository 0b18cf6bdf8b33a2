// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_matching/ground/known_ground.hpp"

#include <cmath>
#include <utility>

#include "common/grid/grid2.hpp"

namespace adit {
namespace {

constexpr std::size_t kTerrains = 4;
constexpr double kDrivenCellM = 0.5;
// A return this near the ground, plus a share of its range for the error of the attitude, is one of
// the ground, unless an obstacle higher than kObstacleM stands there.
constexpr double kNearM = 0.15;
constexpr double kNearShare = 0.01;
constexpr double kObstacleM = 0.3;
constexpr double kTunnelM = 2.5;  // farther below the ground that was driven on is another level

std::uint64_t key(const Eigen::Vector2i& cell) {
  return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(cell.y())) << 32U) |
         static_cast<std::uint32_t>(cell.x());
}

KnownGround::Surface surface_in(const TerrainCell& cell, double z_level_m, double near_m) {
  using Surface = KnownGround::Surface;
  if (cell.ground != Ground::kObserved || !std::isfinite(cell.low_m)) return Surface::kUnknown;
  const double above_m = z_level_m - static_cast<double>(cell.low_m);
  // Near the foot of a wall a cell holds both, near its top the roof.
  if (!(cell.coefficient_m < kObstacleM)) {
    const double top_m = static_cast<double>(cell.coefficient_m) + near_m;
    return above_m < near_m || above_m > top_m ? Surface::kUnknown : Surface::kWall;
  }
  if (above_m < near_m) return Surface::kGround;
  if (above_m > static_cast<double>(cell.clearance_m) - near_m) return Surface::kRoof;
  return Surface::kUnknown;
}

/// Whether a part of the ground is higher or lower than roughness and ruts explain.
bool has_slope(const TerrainMap& terrain) {
  constexpr float kRiseM = 0.25F;
  constexpr double kShare = 0.05;
  int ground = 0;
  int sloped = 0;
  for (const TerrainCell& cell : terrain.cells) {
    if (cell.ground != Ground::kObserved || !(cell.coefficient_m < kObstacleM)) continue;
    ++ground;
    if (std::abs(cell.low_m) > kRiseM) ++sloped;
  }
  return sloped > kShare * ground;
}

}  // namespace

void KnownGround::add(TerrainMap terrain, double z_odom_level_m,
                      const Eigen::Vector2d& slope_level) {
  shows_slope_ |= has_slope(terrain);
  const Pose2 T_level_odom = terrain.T_odom_level.inverse();
  terrains_.push_front({std::move(terrain), z_odom_level_m, slope_level, T_level_odom});
  if (terrains_.size() > kTerrains) terrains_.pop_back();
}

void KnownGround::add(const Eigen::Vector2d& p_odom, double z_odom_m) {
  driven_z_m_[key(cell_of(p_odom, kDrivenCellM))] = static_cast<float>(z_odom_m);
}

void KnownGround::clear() {
  terrains_.clear();
  driven_z_m_.clear();
  shows_slope_ = false;
}

KnownGround::Surface KnownGround::surface_at(const Eigen::Vector2d& p_odom, double z_odom_m,
                                             double range_m) const {
  const double near_m = kNearM + kNearShare * range_m;
  for (const PlacedTerrain& placed : terrains_) {
    const Eigen::Vector2d p_level = placed.T_level_odom * p_odom;
    const Eigen::Vector2i cell = placed.map.cell_at(p_level);
    if (!placed.map.cells.contains(cell)) continue;
    const double z_level_m = z_odom_m - placed.z_m - placed.slope.dot(p_level);
    const Surface surface = surface_in(placed.map.cells.at(cell), z_level_m, near_m);
    if (surface != Surface::kUnknown) return surface;
  }
  const auto driven = driven_z_m_.find(key(cell_of(p_odom, kDrivenCellM)));
  if (driven == driven_z_m_.end()) return Surface::kUnknown;
  const double above_m = z_odom_m - static_cast<double>(driven->second);
  return above_m < near_m && above_m > -kTunnelM ? Surface::kGround : Surface::kUnknown;
}

}  // namespace adit
