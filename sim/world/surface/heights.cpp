// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/surface/heights.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/world/relief.hpp"

namespace adit {
namespace {

constexpr double kClearanceMin = 0.05;

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

Heights::Heights(const HeightsDescription& description, int seed,
                 std::shared_ptr<const TunnelRises> rises)
    : profile_(description.profile_m, HeightProfile::grade_named(description.grade)),
      heading_(std::cos(description.heading_rad), std::sin(description.heading_rad)),
      clearance_m_(description.clearance_m),
      rolls_(description.rolls, relief_seed(seed, ReliefKind::kRolls)),
      rises_(std::move(rises)),
      floor_relief_(description.floor_relief, relief_seed(seed, ReliefKind::kFloor)),
      roof_relief_(description.roof_relief, relief_seed(seed, ReliefKind::kRoof)) {}

double Heights::base(const Eigen::Vector2d& p_world) const {
  const double seam = profile_.at(heading_.dot(p_world)) + rolls_(p_world);
  return rises_ ? seam + (*rises_)(p_world) : seam;
}

double Heights::floor(const Eigen::Vector2d& p_world) const {
  return changed(floor_changes_, p_world, base(p_world) + floor_relief_(p_world));
}

double Heights::roof(const Eigen::Vector2d& p_world) const {
  const double roof = base(p_world) + clearance_m_ + roof_relief_(p_world);
  return std::max(changed(roof_changes_, p_world, roof), floor(p_world) + kClearanceMin);
}

}  // namespace adit
