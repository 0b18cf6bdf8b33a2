// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/plan/plan_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/geometry/ring.hpp"
#include "sim/world/plan/plan_geometry.hpp"

namespace adit {
namespace {

Eigen::AlignedBox2d box_of(const TunnelSegment& segment) {
  Eigen::AlignedBox2d box(segment.from);
  box.extend(segment.from + segment.length_m * segment.along);
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(segment.half_width_m);
  return {box.min() - margin, box.max() + margin};
}

Eigen::AlignedBox2d box_of(const PlanPolygon& polygon) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& corner : polygon.corners) box.extend(corner);
  return box;
}

}  // namespace

double depth_m(const TunnelSegment& segment, const Eigen::Vector2d& p_world) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const Eigen::Vector2d p = p_world - segment.from;
  const double s = p.dot(segment.along);
  const double across = std::abs(cross(segment.along, p));
  const double beside = segment.half_width_m - across;
  const double behind_start = segment.flat_start ? s : kFar;
  const double before_end = segment.flat_end ? segment.length_m - s : kFar;
  const double between_ends = std::min(behind_start, before_end);
  if (between_ends < 0.0) return -std::hypot(between_ends, std::min(beside, 0.0));
  const double beyond = std::max(-s, s - segment.length_m);  // for a round end
  const double round = beyond > 0.0 ? segment.half_width_m - std::hypot(beyond, across) : beside;
  return std::min(round, between_ends);
}

double depth_m(const PlanPolygon& polygon, const Eigen::Vector2d& p_world) {
  double distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
    const Eigen::Vector2d& a = polygon.corners[i];
    const Eigen::Vector2d& b = polygon.corners[(i + 1) % polygon.corners.size()];
    distance = std::min(distance, distance_to_segment(p_world, a, b));
  }
  return encloses(polygon.corners, p_world) ? distance : -distance;
}

double depth_m(const PlanShape& shape, const Eigen::Vector2d& p_world) {
  if (const auto* segment = std::get_if<TunnelSegment>(&shape)) return depth_m(*segment, p_world);
  return depth_m(std::get<PlanPolygon>(shape), p_world);
}

Eigen::AlignedBox2d bounds(const PlanShape& shape) {
  return std::visit([](const auto& s) { return box_of(s); }, shape);
}

Eigen::AlignedBox2d bounds(const std::vector<PlanShape>& shapes) {
  Eigen::AlignedBox2d all;
  for (const PlanShape& shape : shapes) all.extend(bounds(shape));
  return all;
}

PlanBuckets::PlanBuckets(const std::vector<PlanShape>& shapes, double side_m, double reach_m,
                         const Eigen::AlignedBox2d& all)
    : side_m_(side_m) {
  origin_ = all.min().array() - reach_m;
  columns_ = static_cast<int>(std::ceil((all.sizes().x() + 2.0 * reach_m) / side_m));
  rows_ = static_cast<int>(std::ceil((all.sizes().y() + 2.0 * reach_m) / side_m));

  std::vector<std::vector<std::size_t>> near;
  starts_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
  for (const PlanShape& shape : shapes) {
    near.push_back(squares_near(shape, reach_m));
    for (const std::size_t square : near.back()) ++starts_[square + 1];
  }
  for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  shapes_.resize(starts_.back());
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (std::size_t i = 0; i < near.size(); ++i) {
    for (const std::size_t square : near[i])
      shapes_[next[square]++] = static_cast<std::uint32_t>(i);
  }
}

std::vector<std::size_t> PlanBuckets::squares_near(const PlanShape& shape, double reach_m) const {
  const Eigen::AlignedBox2d box = bounds(shape);
  const auto index = [&](double offset_m, int count) {
    return std::clamp(static_cast<int>(std::floor(offset_m / side_m_)), 0, count - 1);
  };
  const int column_low = index(box.min().x() - reach_m - origin_.x(), columns_);
  const int column_high = index(box.max().x() + reach_m - origin_.x(), columns_);
  const int row_low = index(box.min().y() - reach_m - origin_.y(), rows_);
  const int row_high = index(box.max().y() + reach_m - origin_.y(), rows_);
  const double from_middle = side_m_ * std::numbers::sqrt2 / 2.0 + reach_m;
  std::vector<std::size_t> squares;
  for (int row = row_low; row <= row_high; ++row) {
    for (int column = column_low; column <= column_high; ++column) {
      const Eigen::Vector2d middle = origin_ + side_m_ * Eigen::Vector2d(column + 0.5, row + 0.5);
      if (depth_m(shape, middle) < -from_middle) continue;
      squares.push_back(static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                        static_cast<std::size_t>(column));
    }
  }
  return squares;
}

std::span<const std::uint32_t> PlanBuckets::at(const Eigen::Vector2d& p_world) const {
  const Eigen::Vector2d place = (p_world - origin_) / side_m_;
  const bool within = place.x() >= 0.0 && place.y() >= 0.0 && place.x() < columns_ &&
                      place.y() < rows_;  // false for NaN, too
  if (!within) return {};
  return at(static_cast<int>(place.x()), static_cast<int>(place.y()));
}

std::span<const std::uint32_t> PlanBuckets::at(int column, int row) const {
  const std::size_t square = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                             static_cast<std::size_t>(column);
  return std::span(shapes_).subspan(starts_[square], starts_[square + 1] - starts_[square]);
}

}  // namespace adit
