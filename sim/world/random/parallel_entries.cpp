// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause

#include <fmt/format.h>

#include "sim/world/plan/tunnel_line.hpp"
#include "sim/world/random/topologies.hpp"

namespace adit {
namespace {

constexpr double kLengthMin = 120.0;  // minimum for two entries [m]

/// The line `spacing_m` to the left of `main`, from `kUndamagedLength` to its end.
std::vector<Eigen::Vector2d> line_beside(const TunnelLine& main, double spacing_m) {
  std::vector<Eigen::Vector2d> line{main.beside(kUndamagedLength, spacing_m)};
  double s_m = 0.0;
  for (std::size_t i = 1; i < main.points.size(); ++i) {
    s_m += (main.points[i] - main.points[i - 1]).norm();
    // Within a segment, off its ends, where the offset line has a step.
    if (s_m > kUndamagedLength + 5.0) line.push_back(main.beside(s_m - 1.0, spacing_m));
  }
  return line;
}

}  // namespace

PlanDescription parallel_entries(double length_m, RandomGenerator& rng) {
  PlanDescription plan;
  const bool one = length_m < kLengthMin;
  const int beside = one ? 0 : length_m < 250.0 ? 1 : rng.between(1, 2);
  const double spacing_m = rng.between(11.0, 17.0);
  const double crosscut_every_m = rng.between(18.0, 40.0);
  // main + beside · (main − sound) + beside · spacing · (main − sound) / every = length
  const double per_m = beside * (1.0 + spacing_m / crosscut_every_m);
  plan.tunnels.push_back(main_tunnel((length_m + per_m * kUndamagedLength) / (1.0 + per_m), rng));
  const TunnelLine main = tunnel_lines(plan).front();

  const double end_m = main.length_m() - 3.0;
  for (int entry = 1; entry <= beside; ++entry) {
    plan.tunnels.push_back(tunnel_along(fmt::format("entry_{}", entry),
                                        line_beside(main, entry * spacing_m),
                                        rng.between(2.6, 4.5)));
    int crosscut = 0;
    for (double s_m = kUndamagedLength + 2.0; s_m < end_m; s_m += crosscut_every_m) {
      const std::vector<Eigen::Vector2d> line{main.beside(s_m, (entry - 1) * spacing_m),
                                              main.beside(s_m, entry * spacing_m)};
      plan.tunnels.push_back(tunnel_along(fmt::format("crosscut_{}_{}", entry, ++crosscut), line,
                                          rng.between(2.5, 3.5)));
    }
  }
  return plan;
}

}  // namespace adit
