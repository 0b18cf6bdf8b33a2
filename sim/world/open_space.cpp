// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/open_space.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/config/number_text.hpp"
#include "sim/world/corner_list.hpp"
#include "sim/world/seed_of.hpp"

namespace adit {
namespace {

// Of the roughness of a wall: what it has all the way up, and what varies with height.
constexpr double kShareInPlan = 0.6;
constexpr double kBucketSide = 4.0;

Relief wall_relief(const WorldDescription& description, double share, ReliefKind kind) {
  ReliefDescription relief = description.wall_relief;
  relief.height_m *= share;
  return {relief, seed_of(description.seed, kind)};
}

/// Whether the end of a drift opens into another drift, or a room.
bool opens(const Eigen::Vector2d& end, const DriftLine& drift, const std::vector<DriftLine>& drifts,
           const std::vector<PlanPolygon>& rooms) {
  const auto is_drift = [&](const DriftLine& other) {
    return &other != &drift && other.reaches(end);
  };
  const auto is_room = [&](const PlanPolygon& room) {
    return depth_m(room, end) > -drift.width_m / 2.0;
  };
  return std::any_of(drifts.begin(), drifts.end(), is_drift) ||
         std::any_of(rooms.begin(), rooms.end(), is_room);
}

/// The middle of the drift in pieces. Ends are flat in rock. Others are round and so reach into
/// what they open into: edge to edge there would be a seam of no depth.
std::vector<DriftPiece> pieces_of(const DriftLine& drift, const std::vector<DriftLine>& drifts,
                                  const std::vector<PlanPolygon>& rooms) {
  std::vector<DriftPiece> pieces;
  for (std::size_t i = 1; i < drift.points.size(); ++i) {
    const Eigen::Vector2d along = drift.points[i] - drift.points[i - 1];
    const double length = along.norm();
    pieces.push_back(
        {drift.points[i - 1], along / length, length, drift.width_m / 2.0, false, false});
  }
  const bool ring = drift.points.front() == drift.points.back();
  const auto is_flat = [&](const Eigen::Vector2d& end) {
    return !ring && !opens(end, drift, drifts, rooms);
  };
  pieces.front().flat_start = !drift.entrance && is_flat(drift.points.front());
  pieces.back().flat_end = is_flat(drift.points.back());
  return pieces;
}

std::vector<PlanPolygon> polygons_of(const std::vector<PolygonDescription>& descriptions,
                                     const std::string& kind) {
  std::vector<PlanPolygon> polygons;
  for (const PolygonDescription& polygon : descriptions) {
    polygons.push_back({corner_list(polygon.points_m, 3, kind + " '" + polygon.name + "'")});
  }
  return polygons;
}

DriftPiece apron_of(const DriftPiece& first) {
  return {first.from, -first.along, OpenSpace::kApronLength, first.half_width_m, true, true};
}

/// Refuses what is no number, too.
void require_within(double farthest_m) {
  if (farthest_m <= OpenSpace::kExtentMax) return;
  throw std::invalid_argument("the plan reaches " + number_text(farthest_m) +
                              " m from the origin; " + number_text(OpenSpace::kExtentMax) +
                              " m is the most");
}

void check_extent(const std::vector<PlanShape>& shapes) {
  for (const PlanShape& shape : shapes) {
    const Eigen::AlignedBox2d box = bounds(shape);
    require_within(std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff()));
  }
}

/// Before anything is reckoned from them: a length that overflows leaves no number in the bounds.
void check_points(const std::vector<DriftLine>& drifts) {
  for (const DriftLine& drift : drifts) {
    for (const Eigen::Vector2d& p : drift.points) require_within(p.lpNorm<Eigen::Infinity>());
  }
}

}  // namespace

OpenSpace::Shapes OpenSpace::shapes_of(const PlanDescription& plan,
                                       const std::vector<DriftLine>& drifts) {
  check_points(drifts);
  const std::vector<PlanPolygon> rooms = polygons_of(plan.rooms, "room");
  const std::vector<PlanPolygon> pillars = polygons_of(plan.pillars, "pillar");
  Shapes shapes;
  for (const DriftLine& drift : drifts) {
    const std::vector<DriftPiece> pieces = pieces_of(drift, drifts, rooms);
    shapes.all.insert(shapes.all.end(), pieces.begin(), pieces.end());
    if (!drift.entrance) continue;
    shapes.aprons.push_back(apron_of(pieces.front()));
    DriftPiece into_the_drift = shapes.aprons.back();
    into_the_drift.flat_start = false;
    shapes.all.push_back(into_the_drift);
  }
  shapes.all.insert(shapes.all.end(), rooms.begin(), rooms.end());
  shapes.open = shapes.all.size();
  if (shapes.open == 0) throw std::invalid_argument("the plan has neither a drift nor a room");
  shapes.all.insert(shapes.all.end(), pillars.begin(), pillars.end());
  check_extent(shapes.all);
  return shapes;
}

PlanBuckets OpenSpace::buckets_of(const Shapes& shapes, double grid_m, double reach_m) {
  return {shapes.all, grid_m * std::ceil(kBucketSide / grid_m), reach_m};
}

OpenSpace::OpenSpace(const WorldDescription& description, const std::vector<DriftLine>& drifts)
    : shapes_(shapes_of(description.plan, drifts)),
      reach_m_(description.wall_relief.height_m + 2.0 * description.grid_m),
      buckets_(buckets_of(shapes_, description.grid_m, reach_m_)),
      relief_in_plan_(wall_relief(description, kShareInPlan, ReliefKind::kWallInPlan)),
      relief_in_height_(wall_relief(description, 1.0 - kShareInPlan, ReliefKind::kWallInHeight)) {}

double OpenSpace::planned_depth_m(const Eigen::Vector2d& p_world) const {
  double depth = -reach_m_;
  for (const std::uint32_t i : buckets_.at(p_world)) {
    const double of_shape = adit::depth_m(shapes_.all[i], p_world);
    depth = i < shapes_.open ? std::max(depth, of_shape) : std::min(depth, -of_shape);
  }
  return depth;
}

double OpenSpace::depth_m(const Eigen::Vector2d& p_world) const {
  const double depth = planned_depth_m(p_world);
  if (std::abs(depth) >= reach_m_) return depth;
  return depth + relief_in_plan_(p_world);
}

bool OpenSpace::on_apron(const Eigen::Vector2d& p_world) const {
  return std::any_of(shapes_.aprons.begin(), shapes_.aprons.end(), [&](DriftPiece apron) {
    apron.half_width_m += reach_m_;
    apron.length_m += reach_m_;
    return adit::depth_m(apron, p_world) > 0.0;
  });
}

}  // namespace adit
