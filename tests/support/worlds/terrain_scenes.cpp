// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/worlds/terrain_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace adit {
namespace {

constexpr double kWallM = 0.4;  // observed depth of the walls
constexpr double kWallHighM = 1.1;
constexpr double kRailGaugeM = 0.9;
constexpr double kRailHighM = 0.1;
constexpr double kStraightM = 2.0;  // length of the straight lane near the robot

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

bool in(const CorridorScene::Post& disc, const Eigen::Vector2d& to_corridor) {
  return (to_corridor - Eigen::Vector2d(disc.along_m, disc.left_m)).norm() <= disc.radius_m;
}

bool in_any(const std::vector<CorridorScene::Post>& discs, const Eigen::Vector2d& to_corridor) {
  return std::any_of(discs.begin(), discs.end(),
                     [&](const auto& disc) { return in(disc, to_corridor); });
}

TerrainCell cell_at(const CorridorScene& scene, const Eigen::Vector2d& to_corridor, double cell_m) {
  const double beside = std::abs(to_corridor.y()) - scene.width_m / 2.0;
  const double beyond = std::max(beside, to_corridor.x() - scene.end_m);
  if (beyond > kWallM) return unmeasured_cell(Ground::kNeverObserved);
  if (beyond > 0.0 || in_any(scene.posts, to_corridor)) return obstacle_cell(kWallHighM);
  if (in_any(scene.shadows, to_corridor)) return unmeasured_cell(Ground::kOccluded);
  const bool rail = std::abs(std::abs(to_corridor.y()) - kRailGaugeM / 2.0) < cell_m / 2.0;
  return obstacle_cell(scene.rails && rail ? kRailHighM : 0.02);
}

/// Whether a post is far enough from the lane and from the robot.
bool leaves_room(const CorridorScene& scene, const CorridorScene::Post& post, double lane_half_m) {
  for (double along = -3.0; along < 15.0; along += 0.1) {
    const Eigen::Vector2d lane(along, scene.lane_m(along));
    if ((lane - Eigen::Vector2d(post.along_m, post.left_m)).norm() < lane_half_m + post.radius_m) {
      return false;
    }
  }
  return true;
}

}  // namespace

TerrainMap even_ground(double side_m, double cell_m) {
  TerrainMap terrain;
  terrain.utime = 1;
  terrain.cell_m = cell_m;
  terrain.p_level_corner.setConstant(-side_m / 2.0);
  const int side = static_cast<int>(std::lround(side_m / cell_m));
  terrain.cells = {side, side, obstacle_cell(0.0)};
  return terrain;
}

TerrainCell obstacle_cell(double height_m) {
  const auto height = static_cast<float>(height_m);
  return {Ground::kObserved,
          20,
          0.0F,
          height,
          height,
          std::numeric_limits<float>::infinity(),
          0.0F,
          0.0F};
}

TerrainCell unmeasured_cell(Ground ground) {
  return {ground, 0, kNan, kNan, kNan, kNan, kNan, kNan};
}

TerrainCell roofed_cell(double clearance_m) {
  TerrainCell cell = obstacle_cell(0.0);
  cell.clearance_m = static_cast<float>(clearance_m);
  return cell;
}

void paint(TerrainMap& terrain, const TerrainCell& cell,
           const std::function<bool(const Eigen::Vector2d&)>& inside) {
  for (int row = 0; row < terrain.cells.rows(); ++row) {
    for (int column = 0; column < terrain.cells.columns(); ++column) {
      if (inside(terrain.centre(column, row))) terrain.cells.at({column, row}) = cell;
    }
  }
}

void paint_box(TerrainMap& terrain, const TerrainCell& cell, const Eigen::Vector2d& low,
               const Eigen::Vector2d& high) {
  paint(terrain, cell, [&](const Eigen::Vector2d& p) {
    return (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
  });
}

void paint_disc(TerrainMap& terrain, const TerrainCell& cell, const Eigen::Vector2d& middle,
                double radius_m) {
  paint(terrain, cell, [&](const Eigen::Vector2d& p) { return (p - middle).norm() <= radius_m; });
}

TerrainMap mirrored(const TerrainMap& terrain) {
  TerrainMap image = terrain;
  for (int row = 0; row < terrain.cells.rows(); ++row) {
    for (int column = 0; column < terrain.cells.columns(); ++column) {
      image.cells.at({column, row}) = terrain.cells.at({column, terrain.cells.rows() - 1 - row});
    }
  }
  return image;
}

Eigen::Vector2d CorridorScene::to_corridor(const Eigen::Vector2d& p_level) const {
  if (p_level.x() <= 0.0 || curvature_1_m == 0.0) return p_level;
  const double radius = 1.0 / curvature_1_m;
  const Eigen::Vector2d from_middle(p_level.x(), radius - p_level.y());
  const double side = std::copysign(1.0, radius);
  const double angle = std::atan2(from_middle.x(), side * from_middle.y());
  return {std::abs(radius) * angle, radius - side * from_middle.norm()};
}

double CorridorScene::lane_m(double along_m) const {
  const double distance_m = std::max(0.0, along_m - kStraightM);
  const double rise = std::min(1.0, distance_m / kStraightM);  // smooth start
  return rise * rise * lane_swing_m *
         std::sin(2.0 * std::numbers::pi * distance_m / lane_wave_m + lane_phase_rad);
}

CorridorScene random_corridor(std::uint32_t seed, double lane_half_m) {
  std::mt19937 engine(seed);
  const auto draw = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  };
  CorridorScene scene;
  scene.curvature_1_m = draw(-0.08, 0.08);
  scene.width_m = draw(3.0, 5.0);
  scene.lane_swing_m = std::min(draw(0.0, 0.6), scene.width_m / 2.0 - lane_half_m);
  scene.lane_wave_m = draw(9.0, 14.0);
  scene.lane_phase_rad = draw(-std::numbers::pi, std::numbers::pi);
  scene.rails = draw(0.0, 1.0) < 0.5;
  const int posts = static_cast<int>(draw(0.0, 15.0));
  const double half = scene.width_m / 2.0;
  for (int i = 0; i < posts; ++i) {
    const CorridorScene::Post post{draw(-3.0, 14.0), draw(-half, half), draw(0.1, 0.2)};
    if (leaves_room(scene, post, lane_half_m)) scene.posts.push_back(post);
  }
  for (int i = 0; i < 3; ++i) {
    const CorridorScene::Post shadow{draw(3.0, 14.0), draw(-half, half), draw(0.1, 0.4)};
    if (leaves_room(scene, shadow, lane_half_m)) scene.shadows.push_back(shadow);
  }
  return scene;
}

TerrainMap terrain_of(const CorridorScene& scene, double side_m, double cell_m) {
  TerrainMap terrain = even_ground(side_m, cell_m);
  for (int row = 0; row < terrain.cells.rows(); ++row) {
    for (int column = 0; column < terrain.cells.columns(); ++column) {
      terrain.cells.at({column, row}) =
          cell_at(scene, scene.to_corridor(terrain.centre(column, row)), cell_m);
    }
  }
  return terrain;
}

}  // namespace adit
