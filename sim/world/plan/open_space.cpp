// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/plan/open_space.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "common/config/number_text.hpp"
#include "common/text/message_text.hpp"
#include "sim/world/plan/plan_geometry.hpp"
#include "sim/world/relief.hpp"

namespace adit {
namespace {

// Fraction of the wall relief that is constant over the height; the rest varies with it.
constexpr double kShareInPlan = 0.6;
constexpr double kBucketSide = 4.0;

Relief wall_relief(const WorldDescription& description, double share, ReliefKind kind) {
  ReliefDescription relief = description.wall_relief;
  relief.height_m *= share;
  return {relief, relief_seed(description.seed, kind)};
}

/// Whether the end of a tunnel opens into another tunnel or a room.
bool opens(const Eigen::Vector2d& end, const TunnelLine& tunnel,
           const std::vector<TunnelLine>& tunnels, const std::vector<PlanPolygon>& rooms) {
  const auto is_tunnel = [&](const TunnelLine& other) {
    return &other != &tunnel && other.contains(end);
  };
  const auto is_room = [&](const PlanPolygon& room) {
    return depth_m(room, end) > -tunnel.width_m / 2.0;
  };
  return std::any_of(tunnels.begin(), tunnels.end(), is_tunnel) ||
         std::any_of(rooms.begin(), rooms.end(), is_room);
}

/// The segments of a tunnel. Ends in rock are flat. Other ends are round and overlap the tunnel or
/// room that they open into; edge to edge, a seam of depth 0 would remain.
std::vector<TunnelSegment> tunnel_segments(const TunnelLine& tunnel,
                                           const std::vector<TunnelLine>& tunnels,
                                           const std::vector<PlanPolygon>& rooms) {
  std::vector<TunnelSegment> segments;
  for (std::size_t i = 1; i < tunnel.points.size(); ++i) {
    const Eigen::Vector2d along = tunnel.points[i] - tunnel.points[i - 1];
    const double length = along.norm();
    segments.push_back(
        {tunnel.points[i - 1], along / length, length, tunnel.width_m / 2.0, false, false});
  }
  const bool ring = tunnel.points.front() == tunnel.points.back();
  const auto is_flat = [&](const Eigen::Vector2d& end) {
    return !ring && !opens(end, tunnel, tunnels, rooms);
  };
  segments.front().flat_start = !tunnel.entrance && is_flat(tunnel.points.front());
  segments.back().flat_end = is_flat(tunnel.points.back());
  return segments;
}

TunnelSegment apron_of(const TunnelSegment& first) {
  return {first.from, -first.along, OpenSpace::kApronLength, first.half_width_m, true, true};
}

/// Also rejects NaN.
void require_within(double farthest_m) {
  if (farthest_m <= OpenSpace::kExtentMax) return;
  throw std::invalid_argument(fmt::format("the plan reaches {} m from the origin; {} m is the most",
                                          number_text(farthest_m),
                                          number_text(OpenSpace::kExtentMax)));
}

void check_extent(const std::vector<PlanShape>& shapes) {
  for (const PlanShape& shape : shapes) {
    const Eigen::AlignedBox2d box = bounds(shape);
    require_within(std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff()));
  }
}

/// Checked before any computation with the points, since a length that overflows would leave NaN in
/// the bounds.
void check_points(const std::vector<TunnelLine>& tunnels) {
  for (const TunnelLine& tunnel : tunnels) {
    for (const Eigen::Vector2d& p : tunnel.points) require_within(p.lpNorm<Eigen::Infinity>());
  }
}

}  // namespace

std::vector<PlanPolygon> polygons_of(const std::vector<PolygonDescription>& descriptions,
                                     const std::string& kind) {
  std::vector<PlanPolygon> polygons;
  for (const PolygonDescription& polygon : descriptions) {
    polygons.push_back(
        {corner_list(polygon.points_m, 3, fmt::format("{} {}", kind, quote(polygon.name)))});
  }
  return polygons;
}

OpenSpace::Shapes OpenSpace::shapes_of(const PlanDescription& plan,
                                       const std::vector<TunnelLine>& tunnels) {
  check_points(tunnels);
  const std::vector<PlanPolygon> rooms = polygons_of(plan.rooms, "room");
  const std::vector<PlanPolygon> pillars = polygons_of(plan.pillars, "pillar");
  Shapes shapes;
  for (const TunnelLine& tunnel : tunnels) {
    const std::vector<TunnelSegment> segments = tunnel_segments(tunnel, tunnels, rooms);
    shapes.all.insert(shapes.all.end(), segments.begin(), segments.end());
    if (!tunnel.entrance) continue;
    shapes.aprons.push_back(apron_of(segments.front()));
    TunnelSegment entrance_segment = shapes.aprons.back();
    entrance_segment.flat_start = false;
    shapes.all.push_back(entrance_segment);
  }
  shapes.all.insert(shapes.all.end(), rooms.begin(), rooms.end());
  shapes.open = shapes.all.size();
  if (shapes.open == 0) throw std::invalid_argument("the plan has neither a tunnel nor a room");
  shapes.all.insert(shapes.all.end(), pillars.begin(), pillars.end());
  check_extent(shapes.all);
  return shapes;
}

PlanBuckets OpenSpace::buckets_of(const Shapes& shapes, double grid_m, double reach_m,
                                  const Eigen::AlignedBox2d& all) {
  return {shapes.all, grid_m * std::ceil(kBucketSide / grid_m), reach_m,
          all.isEmpty() ? adit::bounds(shapes.all) : all};
}

OpenSpace::OpenSpace(const WorldDescription& description, const std::vector<TunnelLine>& tunnels)
    : OpenSpace(description, tunnels, Eigen::AlignedBox2d()) {}

OpenSpace::OpenSpace(const WorldDescription& description, const std::vector<TunnelLine>& tunnels,
                     const Eigen::AlignedBox2d& all)
    : shapes_(shapes_of(description.plan, tunnels)),
      reach_m_(description.wall_relief.height_m + 2.0 * description.grid_m),
      buckets_(buckets_of(shapes_, description.grid_m, reach_m_, all)),
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
  return std::any_of(shapes_.aprons.begin(), shapes_.aprons.end(), [&](TunnelSegment apron) {
    apron.half_width_m += reach_m_;
    apron.length_m += reach_m_;
    return adit::depth_m(apron, p_world) > 0.0;
  });
}

}  // namespace adit
