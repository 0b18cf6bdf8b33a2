// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/plan_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/world/plan_segment.hpp"

namespace adit {
namespace {

Eigen::AlignedBox2d box_of(const DriftPiece& piece) {
  Eigen::AlignedBox2d box(piece.from);
  box.extend(piece.from + piece.length_m * piece.along);
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(piece.half_width_m);
  return {box.min() - margin, box.max() + margin};
}

Eigen::AlignedBox2d box_of(const PlanPolygon& polygon) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& corner : polygon.corners) box.extend(corner);
  return box;
}

}  // namespace

double depth_m(const DriftPiece& piece, const Eigen::Vector2d& p_world) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const Eigen::Vector2d p = p_world - piece.from;
  const double s = p.dot(piece.along);
  const double across = std::abs(cross(piece.along, p));
  const double beside = piece.half_width_m - across;
  const double behind_start = piece.flat_start ? s : kFar;
  const double before_end = piece.flat_end ? piece.length_m - s : kFar;
  const double between_ends = std::min(behind_start, before_end);
  if (between_ends < 0.0) return -std::hypot(between_ends, std::min(beside, 0.0));
  const double beyond = std::max(-s, s - piece.length_m);  // of an end that is round
  const double round = beyond > 0.0 ? piece.half_width_m - std::hypot(beyond, across) : beside;
  return std::min(round, between_ends);
}

double depth_m(const PlanPolygon& polygon, const Eigen::Vector2d& p_world) {
  double distance = std::numeric_limits<double>::infinity();
  bool inside = false;  // after an odd number of crossings of a line to infinity along x
  for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
    const Eigen::Vector2d& a = polygon.corners[i];
    const Eigen::Vector2d& b = polygon.corners[(i + 1) % polygon.corners.size()];
    distance = std::min(distance, distance_to_segment(p_world, a, b));
    if ((a.y() > p_world.y()) == (b.y() > p_world.y())) continue;
    const double x = a.x() + (p_world.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    if (x > p_world.x()) inside = !inside;
  }
  return inside ? distance : -distance;
}

double depth_m(const PlanShape& shape, const Eigen::Vector2d& p_world) {
  if (const auto* piece = std::get_if<DriftPiece>(&shape)) return depth_m(*piece, p_world);
  return depth_m(std::get<PlanPolygon>(shape), p_world);
}

Eigen::AlignedBox2d bounds(const PlanShape& shape) {
  return std::visit([](const auto& s) { return box_of(s); }, shape);
}

}  // namespace adit
