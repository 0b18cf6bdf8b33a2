// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/props/stretch.hpp"

#include <cmath>

#include "sim/world/props/placement.hpp"

namespace adit {

std::vector<Eigen::Vector2d> stretch_outline(const DriftLine& drift, double from_m, double to_m) {
  const double aside_m = drift.width_m / 2.0 + kBehindWalls;
  const std::vector<double> places = places_between(from_m, to_m, 1.0);
  std::vector<Eigen::Vector2d> outline;
  for (const double s_m : places) outline.push_back(drift.beside(s_m, -aside_m));
  for (auto it = places.rbegin(); it != places.rend(); ++it) {
    outline.push_back(drift.beside(*it, aside_m));
  }
  return outline;
}

double share_of_stretch(const DriftLine& drift, double from_m, double to_m,
                        const Eigen::Vector2d& p_world) {
  const DriftLine::Place place = drift.place_of(p_world);
  if (std::abs(place.across_m) > drift.width_m / 2.0 + kBehindWalls) return -1.0;
  const double share = (place.s_m - from_m) / (to_m - from_m);
  return share <= 1.0 ? share : -1.0;
}

}  // namespace adit
