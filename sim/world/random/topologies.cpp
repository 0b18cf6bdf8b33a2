// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/random/topologies.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr double kBend =
    0.15;  // maximum deviation of a segment from the direction of the line [rad]

}  // namespace

std::vector<Eigen::Vector2d> wandering_line(const Eigen::Vector2d& from, double heading_rad,
                                            double length_m, RandomGenerator& rng) {
  std::vector<Eigen::Vector2d> line{from};
  for (double left_m = length_m; left_m > 0.0;) {
    double segment_m = std::min(left_m, rng.between(15.0, 35.0));
    if (left_m - segment_m < 5.0) segment_m = left_m;  // no short segment at the end
    const double heading = heading_rad + rng.between(-kBend, kBend);
    line.emplace_back(line.back() +
                      segment_m * Eigen::Vector2d(std::cos(heading), std::sin(heading)));
    left_m -= segment_m;
  }
  return line;
}

TunnelDescription tunnel_along(const std::string& name, const std::vector<Eigen::Vector2d>& line,
                               double width_m) {
  TunnelDescription tunnel{.name = name, .points_m = {}, .width_m = width_m};
  for (const Eigen::Vector2d& point : line) {
    tunnel.points_m.push_back(point.x());
    tunnel.points_m.push_back(point.y());
  }
  return tunnel;
}

TunnelDescription main_tunnel(double length_m, RandomGenerator& rng) {
  const Eigen::Vector2d undamaged_end(std::min(kUndamagedLength, length_m), 0.0);
  std::vector<Eigen::Vector2d> line{Eigen::Vector2d(0.0, 0.0)};
  const auto rest = wandering_line(undamaged_end, 0.0, length_m - undamaged_end.x(), rng);
  line.insert(line.end(), rest.begin(), rest.end());
  TunnelDescription tunnel = tunnel_along("main", line, rng.between(3.0, 5.0));
  tunnel.entrance = true;
  return tunnel;
}

}  // namespace adit
