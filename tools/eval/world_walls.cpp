// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/eval/world_walls.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "sim/world/plan/plan_geometry.hpp"

namespace adit {
namespace {

constexpr double kHeightMinM = 0.1;       // above the floor
constexpr double kHeightMaxM = 2.0;       // above the floor
constexpr double kSteepNormalZMax = 0.5;  // cosine of 60°
constexpr double kFloorSearchDistanceM = 0.3;

using Corners = std::array<Eigen::Vector3d, 3>;

Corners corners_of(const TriangleMesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return {mesh.vertices[a].cast<double>(), mesh.vertices[b].cast<double>(),
          mesh.vertices[c].cast<double>()};
}

/// Height of the floor below the centre of a triangle, or on either side of it: the floor ends at a
/// wall.
std::optional<double> floor_near(const World& world, const Eigen::Vector3d& p_world,
                                 const Eigen::Vector3d& normal) {
  const Eigen::Vector2d middle = p_world.head<2>();
  const Eigen::Vector2d across = kFloorSearchDistanceM * normal.head<2>();
  for (const Eigen::Vector2d& beside :
       {Eigen::Vector2d(0.0, 0.0), across, Eigen::Vector2d(-across)}) {
    const Eigen::Vector2d p = middle + beside;
    const int level = world.truth.level_at({p.x(), p.y(), p_world.z()});
    if (const auto floor_m = world.truth.floor_at(p, level)) return floor_m;
  }
  return std::nullopt;
}

bool may_be_horizontal(PartKind kind) {
  return kind != PartKind::kFloor && kind != PartKind::kRoof && kind != PartKind::kOther;
}

bool is_ignored_part(PartKind kind) {
  return kind == PartKind::kWater || kind == PartKind::kRail || kind == PartKind::kSleeper;
}

bool is_wall(const World& world, std::uint32_t triangle) {
  const PartKind kind = world.mesh.part_of(triangle).kind;
  const Corners corners = corners_of(world.mesh, triangle);
  const Eigen::Vector3d normal =
      (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  if (is_ignored_part(kind) || !normal.allFinite()) return false;
  if (!may_be_horizontal(kind) && std::abs(normal.z()) > kSteepNormalZMax) return false;
  const Eigen::Vector3d middle = (corners[0] + corners[1] + corners[2]) / 3.0;
  const auto floor_m = floor_near(world, middle, normal);
  if (!floor_m) return true;  // height above the floor unknown
  const auto [low, high] = std::minmax({corners[0].z(), corners[1].z(), corners[2].z()});
  return high > *floor_m + kHeightMinM && low < *floor_m + kHeightMaxM;
}

double distance_to(const std::array<Eigen::Vector2d, 3>& outline, const Eigen::Vector2d& p) {
  double nearest = std::numeric_limits<double>::infinity();
  int left = 0;
  int right = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % 3];
    const double side = cross(b - a, p - a);
    if (side > 0.0) ++left;
    if (side < 0.0) ++right;
    nearest = std::min(nearest, distance_to_segment(p, a, b));
  }
  return left == 3 || right == 3 ? 0.0 : nearest;
}

}  // namespace

WorldWalls::WorldWalls(const World& world, double max_distance_m)
    : max_distance_m_(max_distance_m) {
  const auto count = static_cast<std::uint32_t>(world.mesh.triangles.size());
  is_wall_.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    is_wall_[i] = adit::is_wall(world, i);
    if (!is_wall_[i]) continue;
    const Corners corners = corners_of(world.mesh, i);
    outlines_.push_back({corners[0].head<2>(), corners[1].head<2>(), corners[2].head<2>()});
    add_to_cells(static_cast<std::uint32_t>(outlines_.size() - 1));
  }
  std::sort(cells_.begin(), cells_.end());
}

double WorldWalls::distance_m(const Eigen::Vector2d& p_world) const {
  const int j = cell_of(p_world.y());
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = cell_of(p_world.x()) - 1; i <= cell_of(p_world.x()) + 1; ++i) {
    // The cells of one column are adjacent in the order.
    auto at = std::lower_bound(cells_.begin(), cells_.end(), std::pair(Cell{i, j - 1}, 0U));
    for (; at != cells_.end() && at->first <= Cell{i, j + 1}; ++at) {
      nearest = std::min(nearest, distance_to(outlines_[at->second], p_world));
    }
  }
  return nearest <= max_distance_m_ ? nearest : std::numeric_limits<double>::infinity();
}

int WorldWalls::cell_of(double coordinate) const {
  return static_cast<int>(std::floor(coordinate / max_distance_m_));
}

/// Adds an outline to all cells that its bounding box intersects.
void WorldWalls::add_to_cells(std::uint32_t index) {
  const auto& [a, b, c] = outlines_[index];
  const Eigen::Vector2d low = a.cwiseMin(b).cwiseMin(c);
  const Eigen::Vector2d high = a.cwiseMax(b).cwiseMax(c);
  for (int i = cell_of(low.x()); i <= cell_of(high.x()); ++i) {
    for (int j = cell_of(low.y()); j <= cell_of(high.y()); ++j) cells_.push_back({{i, j}, index});
  }
}

NearestPoints::NearestPoints(const std::vector<Eigen::Vector2d>& points, double max_distance_m)
    : max_distance_m_(max_distance_m) {
  points_.reserve(points.size());
  for (const Eigen::Vector2d& p : points) points_.emplace_back(cell_at(p), p);
  std::stable_sort(points_.begin(), points_.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
}

double NearestPoints::distance_m(const Eigen::Vector2d& p) const {
  const auto [i, j] = cell_at(p);
  double nearest = std::numeric_limits<double>::infinity();
  for (int column = i - 1; column <= i + 1; ++column) {
    // The cells of one column are adjacent in the order.
    auto at = std::lower_bound(points_.begin(), points_.end(), Cell{column, j - 1},
                               [](const auto& a, const Cell& cell) { return a.first < cell; });
    for (; at != points_.end() && at->first <= Cell{column, j + 1}; ++at) {
      nearest = std::min(nearest, (at->second - p).norm());
    }
  }
  return nearest <= max_distance_m_ ? nearest : std::numeric_limits<double>::infinity();
}

NearestPoints::Cell NearestPoints::cell_at(const Eigen::Vector2d& p) const {
  return {static_cast<int>(std::floor(p.x() / max_distance_m_)),
          static_cast<int>(std::floor(p.y() / max_distance_m_))};
}

std::vector<Eigen::Vector2d> downsampled(const std::vector<Eigen::Vector2d>& points,
                                         double spacing_m) {
  std::set<std::pair<int, int>> occupied;
  std::vector<Eigen::Vector2d> first;
  for (const Eigen::Vector2d& p : points) {
    const Eigen::Array2i cell = (p / spacing_m).array().floor().cast<int>();
    if (occupied.emplace(cell.x(), cell.y()).second) first.push_back(p);
  }
  return first;
}

}  // namespace adit
