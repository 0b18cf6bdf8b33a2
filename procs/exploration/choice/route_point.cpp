// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/choice/route_point.hpp"

#include <algorithm>
#include <cstddef>

namespace adit {
namespace {

constexpr double kHeadingOverM = 1.5;

}  // namespace

RoutePoint point_along(const std::vector<Eigen::Vector2d>& route_map, double distance_m) {
  std::size_t at = 0;
  for (double travelled = 0.0; at + 1 < route_map.size(); ++at) {
    travelled += (route_map[at + 1] - route_map[at]).norm();
    if (travelled > distance_m) break;
  }
  std::size_t before = at;
  while (before > 0 && (route_map[before] - route_map[at]).norm() < kHeadingOverM) --before;
  std::size_t after = at;
  while (before == at && after + 1 < route_map.size() &&
         (route_map[after] - route_map[at]).norm() < kHeadingOverM) {
    ++after;
  }
  const Eigen::Vector2d direction = route_map[after] - route_map[before];
  return {route_map[at], direction.norm() > 0.0 ? direction.normalized() : Eigen::Vector2d::UnitX(),
          at};
}

std::vector<Eigen::Vector2d> resampled(const std::vector<Eigen::Vector2d>& line, double length_m,
                                       double spacing_m) {
  std::vector<Eigen::Vector2d> points{line.front()};
  double next_m = spacing_m;
  double passed_m = 0.0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double leg_m = (line[i + 1] - line[i]).norm();
    for (; next_m <= std::min(passed_m + leg_m, length_m); next_m += spacing_m) {
      points.emplace_back(line[i] + (next_m - passed_m) / leg_m * (line[i + 1] - line[i]));
    }
    passed_m += leg_m;
  }
  if (passed_m <= length_m) points.push_back(line.back());
  return points;
}

}  // namespace adit
