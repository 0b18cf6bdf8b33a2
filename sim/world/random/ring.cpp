// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/world/random/topologies.hpp"

namespace adit {
namespace {

constexpr double kLengthMin = 110.0;  // minimum for a loop [m]
constexpr int kCorners = 16;

using Line = std::vector<Eigen::Vector2d>;

double length_of(const Line& line) {
  double length = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
  return length;
}

/// A closed line around (1, 0) with a radius of about 1 that starts at the origin.
Line uneven_circle(RandomGenerator& rng) {
  Line line;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = std::numbers::pi - 2.0 * std::numbers::pi * i / kCorners;
    const double radius = i == 0 ? 1.0 : rng.between(0.88, 1.12);
    line.emplace_back(1.0 + radius * std::cos(angle), radius * std::sin(angle));
  }
  line.push_back(line.front());
  return line;
}

}  // namespace

PlanDescription ring(double length_m, RandomGenerator& rng) {
  PlanDescription plan;
  const bool loop = length_m >= kLengthMin;
  plan.tunnels.push_back(main_tunnel(loop ? kUndamagedLength + 2.0 : length_m, rng));
  if (!loop) return plan;

  const auto& points = plan.tunnels.front().points_m;
  const Eigen::Vector2d begin(points[points.size() - 2], points.back());
  Line circle = uneven_circle(rng);
  const auto across_from = static_cast<std::size_t>(rng.between(2, kCorners / 2 - 3));
  Line across{circle[across_from], circle[across_from + kCorners / 2]};
  const double scale =
      (length_m - kUndamagedLength - 2.0) / (length_of(circle) + length_of(across));
  for (Line* line : {&circle, &across}) {
    for (Eigen::Vector2d& point : *line) point = begin + scale * point;
  }
  plan.tunnels.push_back(tunnel_along("ring", circle, rng.between(2.8, 5.0)));
  plan.tunnels.push_back(tunnel_along("across", across, rng.between(2.5, 4.0)));
  return plan;
}

}  // namespace adit
