// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/drift_to_drive.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "sim/world/random/dice.hpp"

namespace adit {
namespace {

constexpr double kLengthM = 45.0;
constexpr double kFreeM = 7.0;  // before the first obstacle
constexpr const char* kDrift = "main";

DriftDescription bent_drift(Dice& dice) {
  DriftDescription drift;
  drift.name = kDrift;
  drift.width_m = dice.between(2.9, 4.2);
  drift.points_m = {0.0, 0.0, 8.0, 0.0};
  double heading = 0.0;
  for (double left_m = kLengthM - 8.0; left_m > 0.0;) {
    const double piece_m = dice.between(5.0, 9.0);
    heading = std::clamp(heading + dice.between(-0.5, 0.5), -1.2, 1.2);
    const std::size_t last = drift.points_m.size() - 2;
    drift.points_m.push_back(drift.points_m[last] + piece_m * std::cos(heading));
    drift.points_m.push_back(drift.points_m[last + 1] + piece_m * std::sin(heading));
    left_m -= piece_m;
  }
  return drift;
}

/// How far from the middle something of that radius may stand: anywhere from where it leaves the
/// lane to where it touches the wall.
double across_m(double width_m, double lane_m, double radius_m, Dice& dice) {
  const double outermost = width_m / 2.0;
  const double innermost = std::min(outermost, lane_m + radius_m - width_m / 2.0);
  return dice.side() * dice.between(std::max(0.0, innermost), outermost);
}

void add_obstacles(double width_m, double lane_m, WorldDescription& world, Dice& dice) {
  for (double s_m = kFreeM; s_m < kLengthM - 3.0; s_m += dice.between(2.5, 6.0)) {
    if (dice.chance(0.7)) {
      const double radius_m = dice.between(0.06, 0.15);
      world.props.posts.push_back({.drift = kDrift,
                                   .from_m = s_m,
                                   .to_m = s_m,
                                   .across_m = across_m(width_m, lane_m, radius_m, dice),
                                   .radius_m = radius_m});
    } else {
      const double radius_m = dice.between(0.3, 0.8);
      world.props.rubble.push_back({.drift = kDrift,
                                    .at_m = s_m,
                                    .across_m = across_m(width_m, lane_m, radius_m, dice),
                                    .radius_m = radius_m,
                                    .height_m = dice.between(0.3, 0.8)});
    }
  }
  if (dice.chance(0.3)) {
    world.props.rails.push_back({.drift = kDrift, .from_m = 0.0, .to_m = kLengthM - 10.0});
  }
}

}  // namespace

WorldDescription drift_to_drive(int seed, double lane_m) {
  Dice dice(static_cast<std::uint64_t>(seed));
  WorldDescription world;
  world.name = "drift_to_drive_" + std::to_string(seed);
  world.seed = seed;
  world.T_world_start = {3.0, 0.0, 0.0};
  world.plan.drifts.push_back(bent_drift(dice));
  add_obstacles(world.plan.drifts.front().width_m, lane_m, world, dice);
  return world;
}

}  // namespace adit
