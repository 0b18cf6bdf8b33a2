// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/passage/wall_distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "common/grid/distance_transform.hpp"
#include "common/types/body_outline.hpp"

namespace adit {
namespace {

using Reason = BlockingCell::Reason;

constexpr std::uint16_t kAllParts = 0xffff;
constexpr double kEdgeStepM = 0.05;    // of the samples along the body: 1 cm at 0.03 m distance
constexpr double kBesideStepM = 0.01;  // of a ray beside the body
// Cells by which ground_layers() widens a shadow, and a region and the placement of a cell of an
// earlier scan an obstacle.
constexpr int kNearReach = 2;

std::uint16_t parts_at(const TerrainMap& terrain, const Eigen::Vector2i& at) {
  const TerrainCell cell = terrain.cells.get(at);
  return cell.ground == Ground::kObserved ? cell.obstacle_parts : std::uint16_t{0};
}

bool is_near_obstacle(const TerrainMap& terrain, const Eigen::Vector2i& at) {
  for (int dy = -kNearReach; dy <= kNearReach; ++dy) {
    for (int dx = -kNearReach; dx <= kNearReach; ++dx) {
      if (parts_at(terrain, at + Eigen::Vector2i(dx, dy)) != 0) return true;
    }
  }
  return false;
}

/// Middle of the parts of a cell, in cells.
Eigen::Vector2d middle_of(std::uint16_t parts, const Eigen::Vector2i& at) {
  Eigen::Vector2d sum(0.0, 0.0);
  int count = 0;
  for (int part = 0; part < CellParts::kCount; ++part) {
    if ((parts & (1U << static_cast<unsigned>(part))) == 0) continue;
    sum += CellParts::centre(part);
    ++count;
  }
  return at.cast<double>() + sum / count;
}

/// The parts of a cell that lie on the line between two points, in cells.
std::uint16_t parts_between(const Eigen::Vector2i& at, const Eigen::Vector2d& a,
                            const Eigen::Vector2d& b) {
  constexpr int kSamples = 32;  // of a line of three cells at most
  std::uint16_t parts = 0;
  for (int i = 0; i <= kSamples; ++i) {
    const Eigen::Vector2d share = a + (b - a) * i / kSamples - at.cast<double>();
    if ((share.array() < 0.0).any() || (share.array() >= 1.0).any()) continue;
    parts |= CellParts::bit_at(share.x(), share.y());
  }
  return parts;
}

/// The blocked parts of a cell whose region shows an obstacle, but which has no points of it: none
/// beside an obstacle; between two parts of it, where it may continue between the beams, those on
/// the line between them; all where no points are near.
std::uint16_t parts_without_points(const TerrainMap& terrain, const Eigen::Vector2i& at) {
  static const std::array<Eigen::Vector2i, 4> kHalf{Eigen::Vector2i{1, 0}, {1, 1}, {0, 1}, {-1, 1}};
  if (!is_near_obstacle(terrain, at)) return kAllParts;
  std::uint16_t parts = 0;
  for (const Eigen::Vector2i& step : kHalf) {
    const std::uint16_t ahead = parts_at(terrain, at + step);
    const std::uint16_t behind = parts_at(terrain, at - step);
    if (ahead == 0 || behind == 0) continue;
    parts |= parts_between(at, middle_of(ahead, at + step), middle_of(behind, at - step));
  }
  return parts;
}

bool is_by_height(Reason reason) {
  return reason == Reason::kStep || reason == Reason::kBelly || reason == Reason::kRoof ||
         reason == Reason::kSlope;
}

/// Whether an obstacle with points ends below a height above the ground.
bool ends_below(const TerrainCell& cell, double height_m) {
  return cell.ground == Ground::kObserved && cell.obstacle_parts != 0 &&
         cell.coefficient_m < height_m;
}

/// The parts of a cell that block the body.
std::uint16_t blocked_parts(const TerrainMap& terrain, const GroundLayers& layers,
                            const Eigen::Vector2i& at, const Vehicle& vehicle,
                            const GroundLimits& limits) {
  const std::size_t i = layers.index(at.x(), at.y());
  const bool lethal = layers.under_body[i] != 0 || layers.under_wheels[i] != 0;
  if (!lethal && layers.unknown[i] == 0) return 0;
  const bool is_below_leaning = layers.leaning_from[i] != 0;  // blocked in part, by its parts
  if (is_below_leaning && layers.under_wheels[i] == 0 && layers.unknown[i] == 0) return 0;
  const TerrainCell& cell = terrain.cells.at(at);
  const auto reason = lethal_reason(cell, vehicle, limits);
  if (lethal && reason && is_by_height(*reason)) {
    if (cell.obstacle_parts != 0) return cell.obstacle_parts;
    return parts_without_points(terrain, at);
  }
  const bool widened_only = !lethal && !reason;
  return widened_only && is_near_obstacle(terrain, at) ? std::uint16_t{0} : kAllParts;
}

}  // namespace

WallDistance::WallDistance(const TerrainMap& terrain, const GroundLayers& layers,
                           const Pose2& T_level_body, const Vehicle& vehicle,
                           const GroundLimits& limits, double level_beam_m)
    : p_level_corner_(terrain.p_level_corner),
      part_m_(terrain.cell_m / CellParts::kSide),
      half_m_(vehicle.length_m / 2.0, vehicle.width_m / 2.0),
      outline_(body_outline(vehicle).boundary(kEdgeStepM)),
      lean_(terrain, vehicle) {
  Grid2<std::uint8_t> blocked(CellParts::kSide * terrain.cells.columns(),
                              CellParts::kSide * terrain.cells.rows());
  Grid2<std::uint8_t> unseen = blocked;
  bool any_unseen = false;
  const Pose2 T_body_level = T_level_body.inverse();
  const ConvexPolygon footprint = body_outline(vehicle);
  const double under_robot_m = half_m_.norm();
  const auto block = [&](const Eigen::Vector2d& p_level, Grid2<std::uint8_t>& among) {
    const Eigen::Vector2i at = cell_of(p_level - p_level_corner_, part_m_);
    if (!among.contains(at)) return;
    const bool is_near = (p_level - T_level_body.translation()).norm() <= under_robot_m;
    if (!is_near || !footprint.contains(T_body_level * p_level)) among.at(at) = 1;
  };
  for (int row = 0; row < terrain.cells.rows(); ++row) {
    for (int column = 0; column < terrain.cells.columns(); ++column) {
      const std::uint16_t parts = blocked_parts(terrain, layers, {column, row}, vehicle, limits);
      if (parts == 0) continue;
      const bool is_unseen = ends_below(terrain.cells.at({column, row}), level_beam_m);
      any_unseen = any_unseen || is_unseen;
      Grid2<std::uint8_t>& among = is_unseen ? unseen : blocked;
      const Eigen::Vector2d& displacement_m = layers.displacement_m.at({column, row});
      const int steps = static_cast<int>(displacement_m.norm() / part_m_);
      for (int part = 0; part < CellParts::kCount; ++part) {
        if ((parts & (1U << static_cast<unsigned>(part))) == 0) continue;
        const Eigen::Vector2i at(CellParts::kSide * column + part % CellParts::kSide,
                                 CellParts::kSide * row + part / CellParts::kSide);
        const Eigen::Vector2d p = p_level_corner_ + centre_of(at, part_m_);
        for (int step = 0; step <= steps; ++step) {
          block(p + displacement_m * step / std::max(steps, 1), among);
        }
      }
    }
  }
  distance_m_ = distance_transform(blocked, part_m_);
  if (!any_unseen) return;
  const Grid2<float> unseen_m = distance_transform(unseen, part_m_);
  for (std::size_t i = 0; i < unseen_m.size(); ++i) {
    const float nearer_m = std::max(unseen_m[i] - static_cast<float>(kUnseenM), 0.0F);
    distance_m_[i] = std::min(distance_m_[i], nearer_m);
  }
}

double WallDistance::at(const Eigen::Vector2d& p_level) const {
  const Eigen::Vector2d u = (p_level - p_level_corner_) / part_m_ - Eigen::Vector2d::Constant(0.5);
  const Eigen::Vector2i cell(static_cast<int>(std::floor(u.x())),
                             static_cast<int>(std::floor(u.y())));
  if (!distance_m_.contains(cell) || !distance_m_.contains(cell + Eigen::Vector2i(1, 1)))
    return 0.0;
  const Eigen::Vector2d share = u - cell.cast<double>();
  const auto along = [&](int dy) {
    const auto a = static_cast<double>(distance_m_.at(cell + Eigen::Vector2i(0, dy)));
    const auto b = static_cast<double>(distance_m_.at(cell + Eigen::Vector2i(1, dy)));
    return std::lerp(a, b, share.x());
  };
  return std::lerp(along(0), along(1), share.y());
}

/// Along a ray from the axis of the body: steps by the distance, which no obstacle is nearer than.
double WallDistance::free_beside_m(const Eigen::Vector2d& p_level,
                                   const Eigen::Vector2d& direction) const {
  const double max_m = half_m_.y() + kSideMaxM;
  double free_m = 0.0;
  while (free_m < max_m) {
    const double distance_m = at(p_level + free_m * direction);
    if (distance_m < part_m_) return free_m + distance_m - half_m_.y();
    free_m += std::max(distance_m - part_m_ / 2.0, kBesideStepM);
  }
  return kSideMaxM;
}

WallDistance::Sides WallDistance::sides(const Pose2& T_level_body) const {
  const Eigen::Vector2d x(std::cos(T_level_body.theta), std::sin(T_level_body.theta));
  const Eigen::Vector2d y(-x.y(), x.x());
  const int samples = static_cast<int>(std::ceil(2.0 * half_m_.x() / kEdgeStepM));
  const double end_m = half_m_.x() - part_m_;  // what touches the ends is not beside the body
  Sides sides{kSideMaxM, kSideMaxM};
  for (int i = 0; i <= samples; ++i) {
    const double along_m = std::lerp(-end_m, end_m, static_cast<double>(i) / samples);
    const Eigen::Vector2d p = T_level_body.translation() + along_m * x;
    sides.left_m = std::min(sides.left_m, free_beside_m(p, y));
    sides.right_m = std::min(sides.right_m, free_beside_m(p, -y));
  }
  const double top_left_m = lean_.top_m(T_level_body).y();
  sides.left_m -= std::max(top_left_m, 0.0);
  sides.right_m -= std::max(-top_left_m, 0.0);
  return sides;
}

double WallDistance::clearance_m(const Pose2& T_level_body) const {
  const Eigen::Vector2d top_m = lean_.top_m(T_level_body);
  return std::min(outline_clearance_m(T_level_body),
                  outline_clearance_m(T_level_body * Pose2{top_m.x(), top_m.y(), 0.0}));
}

double WallDistance::outline_clearance_m(const Pose2& T_level_outline) const {
  double clearance_m = at(T_level_outline.translation());
  for (const Eigen::Vector2d& p_body : outline_)
    clearance_m = std::min(clearance_m, at(T_level_outline * p_body));
  return clearance_m;
}

}  // namespace adit
