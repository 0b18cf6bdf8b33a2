// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/check_robot/field_of_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/geometry/convex_polygon.hpp"
#include "common/geometry/pose2.hpp"
#include "common/types/body_outline.hpp"

namespace adit {
namespace {

constexpr double kOnTopM = 0.12;
constexpr int kBearings = 720;

/// Length of a ray of a length from a laser inside a polygon in the body frame.
double length_inside_m(const LaserMount& mount, const ConvexPolygon& polygon, double bearing_rad,
                       double length_m) {
  if (polygon.empty()) return 0.0;
  const Eigen::Vector2d direction(std::cos(bearing_rad), std::sin(bearing_rad));
  double from = 0.0;
  double to = length_m;
  for (const ConvexPolygon::Edge& edge : polygon.edges()) {
    const double inside_m = edge.offset_m - edge.normal.dot(mount.T_body_laser.translation());
    const double leaving = edge.normal.dot(direction);
    if (std::abs(leaving) < 1e-12) {
      if (inside_m < 0.0) return 0.0;
    } else if (leaving > 0.0) {
      to = std::min(to, inside_m / leaving);
    } else {
      from = std::max(from, inside_m / leaving);
    }
  }
  return std::max(0.0, to - from);
}

}  // namespace

std::vector<NamedLaser> lasers_of(const Lasers& lasers) {
  std::vector<NamedLaser> named{{"front", lasers.front}};
  if (lasers.has_rear()) named.push_back({"rear", lasers.rear});
  return named;
}

bool looks_over_body(const LaserMount& mount, const Vehicle& vehicle) {
  return mount.height_m >= vehicle.height_m - kOnTopM;
}

double length_in_body_m(const LaserMount& mount, const Vehicle& vehicle, double bearing_rad) {
  return length_inside_m(mount, body_outline(vehicle), bearing_rad,
                         std::numeric_limits<double>::infinity());
}

bool sees(const LaserMount& mount, const Vehicle& vehicle, const Eigen::Vector2d& p_body) {
  const Eigen::Vector2d p_laser = mount.T_body_laser.inverse() * p_body;
  const double range_m = p_laser.norm();
  if (range_m < mount.range_min_m || range_m > mount.range_max_m) return false;
  const double angle = std::atan2(p_laser.y(), p_laser.x());
  if (std::abs(angle) > 0.5 * mount.field_of_view_rad + 1e-9) return false;
  if (looks_over_body(mount, vehicle)) return true;
  // The laser stands in the edge of the body, up to range_min_m deep.
  const ConvexPolygon inside = body_outline(vehicle).grown(-mount.range_min_m);
  return length_inside_m(mount, inside, mount.T_body_laser.theta + angle, range_m) == 0.0;
}

Eigen::Vector2d beside_body(const Vehicle& vehicle, double bearing_rad, double outside_m) {
  const Eigen::Vector2d direction(std::cos(bearing_rad), std::sin(bearing_rad));
  const ConvexPolygon outline = body_outline(vehicle);
  double scale = 0.0;
  for (const ConvexPolygon::Edge& edge : outline.edges())
    scale = std::max(scale, edge.normal.dot(direction) / (edge.offset_m + outside_m));
  return direction / scale;
}

std::vector<BlindArc> blind_arcs(const Lasers& lasers, const Vehicle& vehicle, double outside_m) {
  const std::vector<NamedLaser> named = lasers_of(lasers);
  std::vector<BlindArc> arcs;
  bool was_blind = false;
  for (int i = 0; i <= kBearings; ++i) {
    const double bearing = -std::numbers::pi + 2.0 * std::numbers::pi * i / kBearings;
    const Eigen::Vector2d p_body = beside_body(vehicle, bearing, outside_m);
    const bool blind = std::ranges::none_of(
        named, [&](const NamedLaser& laser) { return sees(laser.mount, vehicle, p_body); });
    if (blind && !was_blind) arcs.push_back({bearing, bearing});
    if (blind) arcs.back().to_rad = bearing;
    was_blind = blind;
  }
  // One arc, not two, that crosses straight behind.
  if (arcs.size() > 1 && arcs.front().from_rad == -std::numbers::pi && was_blind) {
    arcs.back().to_rad = arcs.front().to_rad + 2.0 * std::numbers::pi;
    arcs.erase(arcs.begin());
  }
  return arcs;
}

}  // namespace adit
