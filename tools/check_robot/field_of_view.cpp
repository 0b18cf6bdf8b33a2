// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/check_robot/field_of_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/geometry/pose2.hpp"

namespace adit {
namespace {

constexpr double kOnTopM = 0.12;
constexpr int kBearings = 720;

/// Enters [from, to] of a ray into the slab |x| <= half.
void clip(double p, double direction, double half, double& from, double& to) {
  if (std::abs(direction) < 1e-12) {
    if (std::abs(p) > half) to = -1.0;
    return;
  }
  const double a = (-half - p) / direction;
  const double b = (half - p) / direction;
  from = std::max(from, std::min(a, b));
  to = std::min(to, std::max(a, b));
}

/// Length of a ray of a length inside a box around the origin of the body, of half a size.
double length_in_box_m(const LaserMount& mount, const Eigen::Vector2d& half, double bearing_rad,
                       double length_m) {
  double from = 0.0;
  double to = length_m;
  clip(mount.T_body_laser.x, std::cos(bearing_rad), half.x(), from, to);
  clip(mount.T_body_laser.y, std::sin(bearing_rad), half.y(), from, to);
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
  return length_in_box_m(mount, {0.5 * vehicle.length_m, 0.5 * vehicle.width_m}, bearing_rad,
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
  const Eigen::Vector2d half = 0.5 * Eigen::Vector2d(vehicle.length_m, vehicle.width_m) -
                               Eigen::Vector2d::Constant(mount.range_min_m);
  return length_in_box_m(mount, half.cwiseMax(0.0), mount.T_body_laser.theta + angle, range_m) ==
         0.0;
}

Eigen::Vector2d beside_body(const Vehicle& vehicle, double bearing_rad, double outside_m) {
  const Eigen::Vector2d direction(std::cos(bearing_rad), std::sin(bearing_rad));
  const Eigen::Vector2d half(0.5 * vehicle.length_m + outside_m, 0.5 * vehicle.width_m + outside_m);
  const double scale =
      std::max(std::abs(direction.x()) / half.x(), std::abs(direction.y()) / half.y());
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
