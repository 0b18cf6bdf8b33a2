// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/plan/tunnel_line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "common/text/message_text.hpp"
#include "sim/world/plan/plan_geometry.hpp"

namespace adit {
namespace {

// Tolerance by which a tunnel that ends on the wall of another touches it.
constexpr double kTouchMargin = 0.01;
// Closer points count as the same, since the segment between them has no reliable direction [m].
constexpr double kSamePoint = 1e-3;

TunnelLine line_of(const TunnelDescription& tunnel) {
  const std::string what = fmt::format("tunnel {}", quote(tunnel.name));
  TunnelLine line{tunnel.name,    corner_list(tunnel.points_m, 2, what),
                  tunnel.width_m, tunnel.entrance,
                  tunnel.rise_m,  tunnel.rise_grade,
                  tunnel.level};
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    if ((line.points[i] - line.points[i - 1]).norm() < kSamePoint) {
      throw std::invalid_argument(fmt::format("{} has the same point twice in a row", what));
    }
  }
  return line;
}

TunnelLine entry(const PanelDescription& panel, int i) {
  const double y = i * panel.entry_spacing_m;
  const Pose2& T = panel.T_world_panel;
  return {fmt::format("{}_entry_{}", panel.name, i),
          {T * Eigen::Vector2d(0.0, y), T * Eigen::Vector2d(panel.length_m, y)},
          panel.entry_width_m,
          false};
}

TunnelLine crosscut(const PanelDescription& panel, int j) {
  const double x = panel.first_crosscut_m + j * panel.crosscut_spacing_m;
  const double y = (panel.entries - 1) * panel.entry_spacing_m;
  const double x_last = x + y * std::tan(panel.slant_rad);
  const std::string name = fmt::format("{}_crosscut_{}", panel.name, j);
  if (std::min(x, x_last) < 0.0 || std::max(x, x_last) > panel.length_m) {
    throw std::invalid_argument(fmt::format("tunnel {} leaves its panel, which is {:f} m long",
                                            quote(name), panel.length_m));
  }
  const Pose2& T = panel.T_world_panel;
  return {name,
          {T * Eigen::Vector2d(x, 0.0), T * Eigen::Vector2d(x_last, y)},
          panel.crosscut_width_m,
          false};
}

void add_panel(const PanelDescription& panel, std::vector<TunnelLine>& lines) {
  for (int i = 0; i < panel.entries; ++i) lines.push_back(entry(panel, i));
  if (panel.entries < 2) return;  // nothing to cross to
  for (int j = 0; j < panel.crosscuts; ++j) lines.push_back(crosscut(panel, j));
}

void check_names(const std::vector<TunnelLine>& lines) {
  std::set<std::string> names;
  for (const TunnelLine& line : lines) {
    if (!names.insert(line.name).second) {
      throw std::invalid_argument(fmt::format("two tunnels are named {}", quote(line.name)));
    }
  }
}

}  // namespace

std::vector<Eigen::Vector2d> corner_list(const std::vector<double>& numbers, std::size_t least,
                                         const std::string& what) {
  if (numbers.size() % 2 != 0) {
    throw std::invalid_argument(fmt::format("{}: points_m has an x without its y", what));
  }
  if (numbers.size() / 2 < least) {
    throw std::invalid_argument(fmt::format("{}: points_m has {} points, at least {} are needed",
                                            what, numbers.size() / 2, least));
  }
  if (!std::all_of(numbers.begin(), numbers.end(), [](double n) { return std::isfinite(n); })) {
    throw std::invalid_argument(fmt::format("{}: points_m has a number that is not finite", what));
  }
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < numbers.size(); i += 2)
    points.emplace_back(numbers[i], numbers[i + 1]);
  return points;
}

double TunnelLine::length_m() const {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

TunnelLine::Station TunnelLine::at(double s_m) const {
  double left = std::max(s_m, 0.0);
  for (std::size_t i = 1;; ++i) {
    const Eigen::Vector2d along = points[i] - points[i - 1];
    const double length = along.norm();
    if (left <= length || i + 1 == points.size()) {
      return {points[i - 1] + std::min(left / length, 1.0) * along,
              std::atan2(along.y(), along.x())};
    }
    left -= length;
  }
}

Eigen::Vector2d TunnelLine::beside(double s_m, double across_m) const {
  const Station station = at(s_m);
  return station.p_world +
         across_m * Eigen::Vector2d(-std::sin(station.heading_rad), std::cos(station.heading_rad));
}

TunnelLine::Place TunnelLine::place_of(const Eigen::Vector2d& p_world) const {
  Place nearest;
  double nearest_m = std::numeric_limits<double>::infinity();
  double begin_m = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Eigen::Vector2d along = points[i] - points[i - 1];
    const Eigen::Vector2d from_begin = p_world - points[i - 1];
    const double share = nearest_share(p_world, points[i - 1], points[i]);
    const double distance_m = (from_begin - share * along).norm();
    if (distance_m < nearest_m) {
      nearest_m = distance_m;
      nearest = {begin_m + share * along.norm(),
                 std::copysign(distance_m, cross(along, from_begin))};
    }
    begin_m += along.norm();
  }
  return nearest;
}

double TunnelLine::distance_m(const Eigen::Vector2d& p_world) const {
  return std::abs(place_of(p_world).across_m);
}

bool TunnelLine::contains(const Eigen::Vector2d& p_world) const {
  return distance_m(p_world) <= width_m / 2.0 + kTouchMargin;
}

std::vector<TunnelLine> tunnel_lines(const PlanDescription& plan) {
  std::vector<TunnelLine> lines;
  for (const TunnelDescription& tunnel : plan.tunnels) lines.push_back(line_of(tunnel));
  for (const PanelDescription& panel : plan.panels) add_panel(panel, lines);
  check_names(lines);
  return lines;
}

const TunnelLine& find_tunnel(const std::vector<TunnelLine>& tunnels, const std::string& name,
                              const std::string& what) {
  std::vector<std::string_view> names;
  for (const TunnelLine& tunnel : tunnels) {
    if (tunnel.name == name) return tunnel;
    names.emplace_back(tunnel.name);
  }
  throw std::invalid_argument(fmt::format(
      "{} is in tunnel {}, but there {}", what, quote(name),
      names.empty() ? "are no tunnels" : fmt::format("are only: {}", fmt::join(names, ", "))));
}

}  // namespace adit
