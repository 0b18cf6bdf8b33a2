// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/heights.hpp"

#include <algorithm>
#include <cmath>

#include "sim/world/seed_of.hpp"

namespace adit {
namespace {

constexpr double kOpeningMin = 0.05;

double changed(const std::vector<HeightChange>& changes, const Eigen::Vector2d& p_world,
               double height_m) {
  for (const HeightChange& change : changes) {
    const bool within = (p_world.array() >= change.low.array()).all() &&
                        (p_world.array() <= change.high.array()).all();
    if (within) height_m = change.apply(p_world, height_m);
  }
  return height_m;
}

}  // namespace

Heights::Heights(const HeightsDescription& description, int seed)
    : profile_(description.profile_m),
      heading_(std::cos(description.heading_rad), std::sin(description.heading_rad)),
      opening_m_(description.opening_m),
      floor_relief_(description.floor_relief, seed_of(seed, ReliefKind::kFloor)),
      roof_relief_(description.roof_relief, seed_of(seed, ReliefKind::kRoof)) {}

double Heights::base(const Eigen::Vector2d& p_world) const {
  return profile_.at(heading_.dot(p_world));
}

double Heights::floor(const Eigen::Vector2d& p_world) const {
  return changed(floor_changes_, p_world, base(p_world) + floor_relief_(p_world));
}

double Heights::roof(const Eigen::Vector2d& p_world) const {
  const double roof = base(p_world) + opening_m_ + roof_relief_(p_world);
  return std::max(changed(roof_changes_, p_world, roof), floor(p_world) + kOpeningMin);
}

}  // namespace adit
