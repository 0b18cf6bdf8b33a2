// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/passable_raster.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sim/world/plan/open_space.hpp"
#include "sim/world/plan/plan_shapes.hpp"

namespace adit {
namespace {

constexpr double kSquaresMax = 4e8;
// Half side of the box around an entrance in which outside ground is added [m].
constexpr double kEntranceReach = OpenSpace::kApronLength + 2.0;

Eigen::AlignedBox2d box_of(const WorldTruth& truth) {
  Eigen::AlignedBox2d box;
  for (const PlanRing& ring : truth.plan) {
    for (const Eigen::Vector2d& p : ring.points) box.extend(p);
  }
  return box;
}

Eigen::AlignedBox2d around(const Eigen::Vector2d& p, double reach_m) {
  return {p.array() - reach_m, p.array() + reach_m};
}

Eigen::Vector2d mean_of(const std::vector<Eigen::Vector2d>& points) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

/// The x of all crossings of the rings with the middle line of each row of squares, ascending.
std::vector<std::vector<double>> crossings(const std::vector<PlanRing>& plan, double y_first,
                                           double step, int rows) {
  std::vector<std::vector<double>> found(static_cast<std::size_t>(rows));
  for (const PlanRing& ring : plan) {
    for (std::size_t i = 0; i < ring.points.size(); ++i) {
      Eigen::Vector2d a = ring.points[i];
      Eigen::Vector2d b = ring.points[(i + 1) % ring.points.size()];
      if (a.y() > b.y()) std::swap(a, b);
      const int first = std::max(0, static_cast<int>(std::ceil((a.y() - y_first) / step)));
      for (int row = first; row < rows && y_first + row * step < b.y(); ++row) {
        const double share = (y_first + row * step - a.y()) / (b.y() - a.y());
        found[static_cast<std::size_t>(row)].push_back(a.x() + share * (b.x() - a.x()));
      }
    }
  }
  for (std::vector<double>& row : found) std::sort(row.begin(), row.end());
  return found;
}

}  // namespace

bool is_passable(const Obstacle& obstacle, double floor_m, const Vehicle& vehicle) {
  const double depth = obstacle.z_high_m - obstacle.z_low_m;
  if (obstacle.kind == PartKind::kWater) return depth <= vehicle.wading_depth_max_m;
  if (obstacle.kind == PartKind::kFloor) {
    return depth <= std::max(vehicle.step_max_m, vehicle.sinkage_max_m);
  }
  const bool under = obstacle.z_low_m >= floor_m + vehicle.height_m;
  const bool over =
      obstacle.z_high_m <= floor_m + std::max(vehicle.belly_clearance_m, vehicle.step_max_m);
  return under || over;
}

PassableRaster::PassableRaster(const WorldTruth& truth, const Vehicle& vehicle, int level) {
  Eigen::AlignedBox2d box = box_of(truth);
  if (box.isEmpty()) return;
  for (const TunnelNode& node : truth.tunnels.nodes) {
    if (node.entrance) box.extend(around(node.p_world, kEntranceReach));
  }
  const Eigen::Vector2d squares = (box.sizes() / kSide).array().ceil();
  if (squares.prod() > kSquaresMax) {
    throw std::invalid_argument("the plan is too large for a raster of its area");
  }
  origin_ = box.min();
  columns_ = static_cast<int>(squares.x());
  rows_ = static_cast<int>(squares.y());
  squares_.assign(index(0, rows_), 0);

  std::vector<PlanRing> rings = truth.plan;
  std::erase_if(rings, [&](const PlanRing& ring) { return ring.level != level; });
  open(rings);
  for (const TunnelNode& node : truth.tunnels.nodes) {
    if (node.entrance && node.level == level) open_ground_at(node, truth, level);
  }
  for (const Obstacle& obstacle : truth.obstacles) {
    if (obstacle.level != level) continue;
    const auto floor = truth.floor_at(mean_of(obstacle.outline), level);
    if (!is_passable(obstacle, floor.value_or(obstacle.z_low_m), vehicle)) close(obstacle);
  }
}

template <class Visit>
void PassableRaster::visit_squares(const Eigen::AlignedBox2d& box, const Visit& visit) {
  const Eigen::Vector2d low = (box.min() - origin_) / kSide;
  const Eigen::Vector2d high = (box.max() - origin_) / kSide;
  const int column_end = std::min(columns_, static_cast<int>(std::floor(high.x())) + 1);
  const int row_end = std::min(rows_, static_cast<int>(std::floor(high.y())) + 1);
  for (int row = std::max(0, static_cast<int>(std::floor(low.y()))); row < row_end; ++row) {
    for (int column = std::max(0, static_cast<int>(std::floor(low.x()))); column < column_end;
         ++column) {
      visit(middle(column, row), squares_[index(column, row)]);
    }
  }
}

void PassableRaster::open(const std::vector<PlanRing>& plan) {
  const auto rows = crossings(plan, origin_.y() + kSide / 2.0, kSide, rows_);
  for (int row = 0; row < rows_; ++row) {
    const std::vector<double>& x = rows[static_cast<std::size_t>(row)];
    for (std::size_t i = 0; i + 1 < x.size(); i += 2) {
      const auto square = [&](double at) {
        return std::clamp(static_cast<int>(std::ceil((at - origin_.x()) / kSide - 0.5)), 0,
                          columns_);
      };
      for (int column = square(x[i]); column < square(x[i + 1]); ++column) {
        squares_[index(column, row)] = 1;
      }
    }
  }
}

void PassableRaster::open_ground_at(const TunnelNode& entrance, const WorldTruth& truth,
                                    int level) {
  visit_squares(around(entrance.p_world, kEntranceReach),
                [&](const Eigen::Vector2d& p, std::uint8_t& square) {
                  if (truth.floor_at(p, level)) square = 1;
                });
}

/// Closes all squares within half a side of the outline, so that thin obstacles are not missed.
void PassableRaster::close(const Obstacle& obstacle) {
  const PlanPolygon outline{obstacle.outline};
  const double reach = kSide / 2.0;
  Eigen::AlignedBox2d box = bounds(outline);
  box = {box.min().array() - reach, box.max().array() + reach};
  visit_squares(box, [&](const Eigen::Vector2d& p, std::uint8_t& square) {
    if (depth_m(outline, p) > -reach) square = 0;
  });
}

}  // namespace adit
