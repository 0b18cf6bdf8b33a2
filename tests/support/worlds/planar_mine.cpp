// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/worlds/planar_mine.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <utility>

#include "tests/support/reachable_area.hpp"

namespace adit::test {
namespace {

constexpr double kLaserHeightM = 0.6;
constexpr double kSnapM = 0.3;  // largest distance of the robot from a reachable cell

double width_at(const TunnelGraph& tunnels, int node) {
  double width = 0.0;
  for (const TunnelEdge& edge : tunnels.edges) {
    if (edge.from == node || edge.to == node) width = std::max(width, edge.width_m);
  }
  return width;
}

/// Whether a wall of the plan closes an entrance of the mine. There is no real wall.
bool is_mouth(const Segment& wall, const TunnelGraph& tunnels, int level) {
  for (std::size_t i = 0; i < tunnels.nodes.size(); ++i) {
    if (!tunnels.nodes[i].entrance || tunnels.nodes[i].level != level) continue;
    const double off = ((wall.a + wall.b) / 2.0 - tunnels.nodes[i].p_world).norm();
    if (off < 0.4 * width_at(tunnels, static_cast<int>(i))) return true;
  }
  return false;
}

void add_ring(const std::vector<Eigen::Vector2d>& points, std::vector<Segment>& walls) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    walls.push_back({points[i], points[(i + 1) % points.size()]});
  }
}

std::vector<Segment> walls_of(const WorldTruth& truth, int number) {
  std::vector<Segment> walls;
  for (const PlanRing& ring : truth.plan) {
    if (ring.level == number) add_ring(ring.points, walls);
  }
  std::erase_if(walls, [&](const Segment& wall) { return is_mouth(wall, truth.tunnels, number); });
  for (const Obstacle& obstacle : truth.obstacles) {
    if (obstacle.kind == PartKind::kWater || obstacle.outline.size() < 3) continue;
    if (obstacle.level != number) continue;
    const double level =
        truth.floor_at(obstacle.outline.front(), number).value_or(0.0) + kLaserHeightM;
    if (obstacle.z_low_m < level && obstacle.z_high_m > level) add_ring(obstacle.outline, walls);
  }
  return walls;
}

/// The reachable cells, for queries by distance.
class Reach {
 public:
  Reach(const ReachableArea& area, int level) {
    for (std::size_t i = 0; i < area.cells.size(); ++i) {
      if (area.levels[i] == level) cells_.insert(cell(area.cells[i]));
    }
  }

  [[nodiscard]] bool near(const Eigen::Vector2d& p, double within_m) const {
    const int reach = static_cast<int>(std::ceil(within_m / ReachableArea::kSide));
    const auto [x, y] = cell(p);
    for (int dy = -reach; dy <= reach; ++dy) {
      for (int dx = -reach; dx <= reach; ++dx) {
        if (std::hypot(dx, dy) * ReachableArea::kSide > within_m) continue;
        if (cells_.count({x + dx, y + dy}) > 0) return true;
      }
    }
    return false;
  }

 private:
  static std::pair<int, int> cell(const Eigen::Vector2d& p) {
    return {static_cast<int>(std::floor(p.x() / ReachableArea::kSide)),
            static_cast<int>(std::floor(p.y() / ReachableArea::kSide))};
  }

  std::set<std::pair<int, int>> cells_;
};

std::vector<Eigen::Vector2d> corridor_of(const TunnelGraph& tunnels, const Reach& reach,
                                         int level) {
  std::vector<Eigen::Vector2d> places;
  for (const TunnelEdge& edge : tunnels.edges) {
    if (edge.level != level) continue;
    double next = PlanarMine::kSpacingM / 2.0;
    double path_length = 0.0;
    for (std::size_t i = 1; i < edge.points.size(); ++i) {
      const Eigen::Vector2d step = edge.points[i] - edge.points[i - 1];
      for (; next <= path_length + step.norm(); next += PlanarMine::kSpacingM) {
        const Eigen::Vector2d p = edge.points[i - 1] + step.normalized() * (next - path_length);
        if (reach.near(p, edge.width_m / 2.0)) places.push_back(p);
      }
      path_length += step.norm();
    }
  }
  return places;
}

}  // namespace

std::vector<PlanarMine> planar_mines(const World& world, const Vehicle& vehicle,
                                     double slope_max_rad) {
  const ReachableArea area = reachable_area(world, vehicle, slope_max_rad);
  std::vector<PlanarMine> mines;
  for (const int level : world.truth.levels) {
    const auto reach = std::make_shared<const Reach>(area, level);
    mines.push_back({WallWorld(walls_of(world.truth, level)), world.T_world_start,
                     [reach](const Eigen::Vector2d& p) { return reach->near(p, kSnapM); },
                     corridor_of(world.truth.tunnels, *reach, level)});
  }
  return mines;
}

PlanarMine planar_mine(const World& world, const Vehicle& vehicle, double slope_max_rad) {
  return planar_mines(world, vehicle, slope_max_rad).front();
}

PlanarMine planar_mine(std::vector<Segment> walls, const Pose2& T_world_start,
                       std::vector<Eigen::Vector2d> corridor, double radius_m) {
  const WallWorld world(std::move(walls));
  return {world, T_world_start,
          [world, radius_m](const Eigen::Vector2d& p) { return !world.clearance(p, radius_m); },
          std::move(corridor)};
}

}  // namespace adit::test
