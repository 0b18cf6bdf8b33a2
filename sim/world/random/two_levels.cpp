// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/random/two_levels.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

#include "sim/world/random/random_generator.hpp"
#include "sim/world/random/topologies.hpp"

namespace adit {
namespace {

using Line = std::vector<Eigen::Vector2d>;

constexpr std::uint64_t kTwoLevelsStream = 0x2e7e150000000000U;
constexpr int kUpper = 0;
constexpr int kRamp = 1;
constexpr int kLower = 2;
constexpr double kTopLength = 26.0;    // of the ramp on the upper level [m]
constexpr double kStraight = 6.0;      // of the ramp, before and after its bend [m]
constexpr double kLanding = 5.0;       // level part of the ramp at both ends [m]
constexpr double kRampCurve = 3.0;     // over which its grade changes [m]
constexpr double kBranchEvery = 11.0;  // [m]

/// Random numbers that all parts need.
struct Layout {
  double main_m = 0.0;    ///< length of `main`
  double side = 1.0;      ///< of the bend of the ramp: 1 left
  double radius_m = 0.0;  ///< of the bend
  double width_m = 0.0;   ///< of main, ramp and lower main
  double depth_m = 0.0;   ///< of the lower level below the upper one

  [[nodiscard]] Eigen::Vector2d at(double x, double y) const { return {x, side * y}; }
};

TunnelDescription on_level(int level, const std::string& name, const Line& line, double width_m) {
  TunnelDescription tunnel = tunnel_along(name, line, width_m);
  tunnel.level = level;
  return tunnel;
}

TunnelDescription below(const Layout& layout, const std::string& name, const Line& line,
                        double width_m) {
  TunnelDescription tunnel = on_level(kLower, name, line, width_m);
  tunnel.rise_m = {0.0, -layout.depth_m};
  return tunnel;
}

double length_of(const Line& line) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) length_m += (line[i] - line[i - 1]).norm();
  return length_m;
}

/// A half circle between two straight stretches.
Line bend(const Layout& layout) {
  constexpr int kSteps = 12;
  const double x = layout.main_m + kTopLength;
  Line line{layout.at(x, 0.0)};
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = std::numbers::pi * i / kSteps;
    line.push_back(layout.at(x + kStraight + layout.radius_m * std::sin(angle),
                             layout.radius_m * (1.0 - std::cos(angle))));
  }
  line.push_back(layout.at(x, 2.0 * layout.radius_m));
  return line;
}

/// Down from 0 by `depth_m`, level at both ends.
std::vector<double> descent(double length_m, double depth_m) {
  const double on_grade_m = length_m - 2.0 * kLanding - kRampCurve;
  const double grade = -depth_m / on_grade_m;
  std::vector<double> rise_m;
  const auto add = [&](double s_m, double z_m) { rise_m.insert(rise_m.end(), {s_m, z_m}); };
  const double begin_m = kLanding;
  const double end_m = length_m - kLanding;
  constexpr int kKnots = 3;
  for (int i = 0; i <= kKnots; ++i) {
    const double s_m = kRampCurve * i / kKnots;
    add(begin_m + s_m, grade * s_m * s_m / (2.0 * kRampCurve));
  }
  for (int i = kKnots; i >= 0; --i) {
    const double s_m = kRampCurve * i / kKnots;
    add(end_m - s_m, -depth_m - grade * s_m * s_m / (2.0 * kRampCurve));
  }
  return rise_m;
}

void add_ramp(const Layout& layout, PlanDescription& plan) {
  const double x = layout.main_m;
  const double y = 2.0 * layout.radius_m;
  plan.tunnels.push_back(on_level(
      kUpper, "ramp_top", {layout.at(x, 0.0), layout.at(x + kTopLength, 0.0)}, layout.width_m));
  const Line line = bend(layout);
  TunnelDescription ramp = on_level(kRamp, "ramp", line, layout.width_m);
  ramp.rise_m = descent(length_of(line), layout.depth_m);
  ramp.rise_grade = "sudden";  // its points are dense where it is smooth
  plan.tunnels.push_back(ramp);
  plan.tunnels.push_back(below(layout, "ramp_foot",
                               {line.back(), layout.at(x + 18.0, y), layout.at(x + 11.0, y - 5.0),
                                layout.at(x + 9.0, y - 12.0), layout.at(x + 9.0, -10.0)},
                               layout.width_m));
}

/// About at right angles to x.
Line branch_line(const Eigen::Vector2d& from, double side, RandomGenerator& rng) {
  const double heading = side * std::numbers::pi / 2.0 + rng.between(-0.1, 0.1);
  const double length_m = rng.between(14.0, 25.0);
  return {from, from + length_m * Eigen::Vector2d(std::cos(heading), std::sin(heading))};
}

void add_upper_branches(const Layout& layout, RandomGenerator& rng, PlanDescription& plan) {
  int count = 0;
  for (double x = kUndamagedLength + 4.0; x < layout.main_m - 4.0; x += kBranchEvery) {
    const Line line = branch_line({x + rng.between(-1.0, 1.0), 0.0}, rng.side(), rng);
    const double width_m = rng.between(2.6, 3.6);
    if (!rng.chance(0.75)) continue;
    plan.tunnels.push_back(
        on_level(kUpper, fmt::format("upper_branch_{}", ++count), line, width_m));
  }
}

/// `lower_main` runs below and beside `main`, its branches below it.
void add_lower_level(const Layout& layout, RandomGenerator& rng, PlanDescription& plan) {
  const double y = -10.0;
  plan.tunnels.push_back(below(layout, "lower_main",
                               {layout.at(layout.main_m + 9.0, y), layout.at(12.0, y)},
                               layout.width_m));
  int count = 0;
  for (double x = layout.main_m - 3.0; x > 16.0; x -= kBranchEvery) {
    const Eigen::Vector2d from = layout.at(x + rng.between(-1.0, 1.0), y);
    // The first one always passes below `main`.
    const double side = count == 0 ? layout.side : rng.side();
    const Line line = branch_line(from, side, rng);
    const double width_m = rng.between(2.6, 3.6);
    if (count > 0 && !rng.chance(0.75)) continue;
    plan.tunnels.push_back(below(layout, fmt::format("lower_branch_{}", ++count), line, width_m));
  }
}

HeightsDescription gentle_heights(RandomGenerator& rng) {
  HeightsDescription heights;
  heights.heading_rad = rng.between(-3.0, 3.0);
  const double grade = rng.between(-0.04, 0.04);
  heights.profile_m = {-100.0, -100.0 * grade, 200.0, 200.0 * grade};
  heights.grade = "sudden";
  heights.floor_relief = {.height_m = rng.between(0.01, 0.05), .length_m = 2.5};
  heights.roof_relief = {.height_m = rng.between(0.03, 0.10), .length_m = 2.0};
  heights.clearance_m = rng.between(1.9, 2.4);
  return heights;
}

}  // namespace

WorldDescription two_levels(int seed) {
  RandomGenerator rng(static_cast<std::uint64_t>(seed) ^ kTwoLevelsStream);
  WorldDescription description;
  description.name = fmt::format("two_levels_{}", seed);
  description.seed = seed;
  description.T_world_start = {3.0, 0.0, 0.0};
  description.heights = gentle_heights(rng);
  description.wall_relief = {.height_m = rng.between(0.05, 0.15), .length_m = 1.5};
  Layout layout;
  layout.main_m = rng.between(45.0, 65.0);
  layout.side = rng.side();
  layout.radius_m = rng.between(9.0, 12.0);
  layout.width_m = rng.between(3.2, 3.8);
  // With the reliefs, which are below 0.3 m together, more than 2 m of rock.
  layout.depth_m = description.heights.clearance_m + rng.between(2.6, 4.2);

  PlanDescription& plan = description.plan;
  plan.tunnels.push_back(
      on_level(kUpper, "main", {{0.0, 0.0}, {layout.main_m, 0.0}}, layout.width_m));
  plan.tunnels.back().entrance = true;
  add_ramp(layout, plan);
  add_upper_branches(layout, rng, plan);
  add_lower_level(layout, rng, plan);
  return description;
}

}  // namespace adit
