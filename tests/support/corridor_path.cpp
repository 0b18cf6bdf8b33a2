// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/corridor_path.hpp"

#include <numbers>
#include <random>

#include "procs/planning/planning.hpp"
#include "tests/support/terrain_scenes.hpp"

namespace adit {
namespace {

constexpr double kHalfCellM = 0.05;

}  // namespace

PlannedPath corridor_path(std::uint32_t seed, const Vehicle& vehicle) {
  PlanningParams params;
  params.vehicle = vehicle;
  const double half_heading = std::numbers::pi / params.c_space.headings;
  std::mt19937 engine(seed);
  const auto draw = [&](double most) {
    return std::uniform_real_distribution<double>(-most, most)(engine);
  };
  const Pose2 T_odom_body{draw(kHalfCellM), draw(kHalfCellM), draw(half_heading)};
  Planning planning(params);
  PlannedPath path = planning.plan(terrain_of(random_corridor(seed)), PlanGoal{}, T_odom_body);
  for (PathPoint& point : path.points) point.T_odom_body = between(T_odom_body, point.T_odom_body);
  return path;
}

}  // namespace adit
