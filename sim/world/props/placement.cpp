// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/props/placement.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/config/number_text.hpp"

namespace adit {
namespace {

void require_along(const TunnelLine& tunnel, double at_m, const std::string& what) {
  if (at_m >= 0.0 && at_m <= tunnel.length_m()) return;
  throw std::invalid_argument(what + ": " + number_text(at_m) + " m is not along tunnel '" +
                              tunnel.name + "', which is " + number_text(tunnel.length_m()) +
                              " m long");
}

}  // namespace

const TunnelLine& tunnel_with(const std::vector<TunnelLine>& tunnels, const std::string& name,
                              double at_m, const std::string& what) {
  const TunnelLine& tunnel = find_tunnel(tunnels, name, what);
  require_along(tunnel, at_m, what);
  return tunnel;
}

const TunnelLine& tunnel_with(const std::vector<TunnelLine>& tunnels, const std::string& name,
                              double from_m, double to_m, const std::string& what) {
  const TunnelLine& tunnel = tunnel_with(tunnels, name, from_m, what);
  require_along(tunnel, to_m, what);
  if (to_m > from_m) return tunnel;
  throw std::invalid_argument(what + ": ends at " + number_text(to_m) + " m, and begins at " +
                              number_text(from_m) + " m");
}

std::vector<double> places_between(double from_m, double to_m, double step_m) {
  const int steps = std::max(1, static_cast<int>(std::ceil((to_m - from_m) / step_m)));
  std::vector<double> places;
  for (int i = 0; i <= steps; ++i) places.push_back(from_m + (to_m - from_m) * i / steps);
  return places;
}

std::vector<Eigen::Vector2d> section_outline(const TunnelLine& tunnel, double from_m, double to_m) {
  const double aside_m = tunnel.width_m / 2.0 + kBehindWalls;
  const std::vector<double> places = places_between(from_m, to_m, 1.0);
  std::vector<Eigen::Vector2d> outline;
  for (const double s_m : places) outline.push_back(tunnel.beside(s_m, -aside_m));
  for (auto it = places.rbegin(); it != places.rend(); ++it) {
    outline.push_back(tunnel.beside(*it, aside_m));
  }
  return outline;
}

double fraction_of_section(const TunnelLine& tunnel, double from_m, double to_m,
                           const Eigen::Vector2d& p_world) {
  const TunnelLine::Place place = tunnel.place_of(p_world);
  if (std::abs(place.across_m) > tunnel.width_m / 2.0 + kBehindWalls) return -1.0;
  const double share = (place.s_m - from_m) / (to_m - from_m);
  return share <= 1.0 ? share : -1.0;
}

}  // namespace adit
