// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sample_mine/synthetic_world.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace adit {
namespace {

constexpr double kCellSize = 1.0;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Distance along a ray of unit direction to a wall; infinite if the ray misses it.
double hit(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction, const Segment& wall) {
  const Eigen::Vector2d along = wall.b - wall.a;
  const double determinant = cross(direction, along);
  if (determinant == 0.0) return kInfinity;
  const Eigen::Vector2d to_wall = wall.a - origin;
  const double distance = cross(to_wall, along) / determinant;
  const double share = cross(to_wall, direction) / determinant;
  return distance >= 0.0 && share >= 0.0 && share <= 1.0 ? distance : kInfinity;
}

double distance_to(const Eigen::Vector2d& p, const Segment& wall) {
  const Eigen::Vector2d along = wall.b - wall.a;
  const double length_squared = std::max(along.squaredNorm(), 1e-18);
  const double share = std::clamp((p - wall.a).dot(along) / length_squared, 0.0, 1.0);
  return (p - wall.a - share * along).norm();
}

int cell_index(double coordinate) { return static_cast<int>(std::floor(coordinate / kCellSize)); }

/// Walks along one axis of the cells (Amanatides & Woo 1987).
struct AxisWalk {
  AxisWalk(double start, double direction) : index(cell_index(start)) {
    if (direction == 0.0) return;
    step = direction > 0.0 ? 1 : -1;
    const double edge = (index + (step > 0 ? 1 : 0)) * kCellSize;
    next = (edge - start) / direction;
    stride = kCellSize / std::abs(direction);
  }

  void advance() {
    index += step;
    next += stride;
  }

  int index;
  int step = 0;
  double next = kInfinity;  // distance at which the ray leaves the present cell
  double stride = kInfinity;
};

/// Where a ray enters and leaves the box from (0, 0) to `size`.
std::pair<double, double> span_in_box(const Eigen::Vector2d& origin,
                                      const Eigen::Vector2d& direction,
                                      const Eigen::Vector2d& size) {
  double enter = 0.0;
  double leave = kInfinity;
  for (int axis = 0; axis < 2; ++axis) {
    if (direction[axis] == 0.0) {
      if (origin[axis] < 0.0 || origin[axis] > size[axis]) return {kInfinity, 0.0};
      continue;
    }
    const double t0 = -origin[axis] / direction[axis];
    const double t1 = (size[axis] - origin[axis]) / direction[axis];
    enter = std::max(enter, std::min(t0, t1));
    leave = std::min(leave, std::max(t0, t1));
  }
  return {enter, leave};
}

}  // namespace

SyntheticWorld::SyntheticWorld(std::vector<Segment> walls) : walls_(std::move(walls)) {
  if (!walls_.empty()) sort_into_cells();
}

std::optional<double> SyntheticWorld::cast(const Eigen::Vector2d& p_world, double angle_rad,
                                           double range_max_m) const {
  const Eigen::Vector2d direction(std::cos(angle_rad), std::sin(angle_rad));
  const Eigen::Vector2d origin = p_world - corner_;
  const auto [enter, leave] =
      span_in_box(origin, direction, kCellSize * Eigen::Vector2d(columns_, rows_));
  if (enter > leave) return std::nullopt;

  const Eigen::Vector2d start = origin + enter * direction;
  AxisWalk x(start.x(), direction.x());
  AxisWalk y(start.y(), direction.y());
  double nearest = kInfinity;
  const double end = std::min(leave, range_max_m) - enter;
  for (double travelled = 0.0; travelled <= end && enter + travelled <= nearest;) {
    for (const int i : cell(x.index, y.index)) {
      nearest = std::min(nearest, hit(p_world, direction, walls_[static_cast<std::size_t>(i)]));
    }
    AxisWalk& first = x.next < y.next ? x : y;
    travelled = first.next;
    first.advance();
  }
  if (nearest > range_max_m) return std::nullopt;
  return nearest;
}

std::optional<double> SyntheticWorld::clearance(const Eigen::Vector2d& p_world,
                                                double radius_m) const {
  const Eigen::Vector2d p = p_world - corner_;
  double nearest = kInfinity;
  for (int row = cell_index(p.y() - radius_m); row <= cell_index(p.y() + radius_m); ++row) {
    for (int col = cell_index(p.x() - radius_m); col <= cell_index(p.x() + radius_m); ++col) {
      for (const int i : cell(col, row)) {
        nearest = std::min(nearest, distance_to(p_world, walls_[static_cast<std::size_t>(i)]));
      }
    }
  }
  if (nearest > radius_m) return std::nullopt;
  return nearest;
}

void SyntheticWorld::sort_into_cells() {
  Eigen::Vector2d low = walls_.front().a;
  Eigen::Vector2d high = low;
  for (const Segment& wall : walls_) {
    low = low.cwiseMin(wall.a).cwiseMin(wall.b);
    high = high.cwiseMax(wall.a).cwiseMax(wall.b);
  }
  corner_ = low - Eigen::Vector2d::Constant(kCellSize);
  columns_ = cell_index(high.x() - corner_.x()) + 2;
  rows_ = cell_index(high.y() - corner_.y()) + 2;
  cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  // A cell takes the walls that come within half its diagonal of its centre, with a little over.
  const double reach = kCellSize * (std::sqrt(0.5) + 1e-6);
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    const Eigen::Vector2d a = walls_[i].a - corner_;
    const Eigen::Vector2d b = walls_[i].b - corner_;
    for (int row = cell_index(std::min(a.y(), b.y()) - 1e-6);
         row <= cell_index(std::max(a.y(), b.y()) + 1e-6); ++row) {
      for (int col = cell_index(std::min(a.x(), b.x()) - 1e-6);
           col <= cell_index(std::max(a.x(), b.x()) + 1e-6); ++col) {
        const Eigen::Vector2d centre = kCellSize * Eigen::Vector2d(col + 0.5, row + 0.5);
        if (distance_to(centre, {a, b}) > reach) continue;
        cells_[index(col, row)].push_back(static_cast<int>(i));
      }
    }
  }
}

std::size_t SyntheticWorld::index(int column, int row) const {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
         static_cast<std::size_t>(column);
}

const std::vector<int>& SyntheticWorld::cell(int column, int row) const {
  static const std::vector<int> kNone;
  if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return kNone;
  return cells_[index(column, row)];
}

}  // namespace adit
