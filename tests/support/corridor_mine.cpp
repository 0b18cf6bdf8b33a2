// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/corridor_mine.hpp"

#include <cmath>
#include <stdexcept>

#include "sim/sweep/tilt_sweep.hpp"
#include "sim/vehicle/body_clearance.hpp"
#include "sim/world/build_world.hpp"
#include "sim/world/random/dice.hpp"
#include "tests/support/corridor_obstacles.hpp"

namespace adit {
namespace {

constexpr double kLengthM = 26.0;
constexpr double kPieceM = 4.0;  // from one bend of the drift to the next
constexpr double kAheadM = 8.0;
constexpr int kTries = 100;

/// The middle of a drift that wanders, and may turn sharply once.
std::vector<double> wandering(Dice& dice) {
  std::vector<double> points{0.0, 0.0};
  const double sharp_at_m = dice.chance(0.3) ? dice.between(8.0, 16.0) : 2.0 * kLengthM;
  const double sharp = dice.side() * dice.between(0.25, 0.7);
  double heading = 0.0;
  for (double s = 0.0; s < kLengthM; s += kPieceM) {
    heading += dice.between(-0.08, 0.08);
    if (s <= sharp_at_m && sharp_at_m < s + kPieceM) heading += sharp;
    const std::size_t last = points.size() - 2;
    points.push_back(points[last] + kPieceM * std::cos(heading));
    points.push_back(points[last + 1] + kPieceM * std::sin(heading));
  }
  return points;
}

WorldDescription bare_drift(int seed, double width_m, Dice& dice) {
  WorldDescription mine;
  mine.name = "corridor";
  mine.seed = seed;
  mine.plan.drifts.push_back({.name = "main", .points_m = wandering(dice), .width_m = width_m});
  mine.heights.opening_m = dice.between(1.75, 2.3);
  mine.heights.floor_relief = {.height_m = dice.between(0.01, 0.03), .length_m = 2.0};
  mine.heights.roof_relief = {.height_m = dice.between(0.03, 0.12), .length_m = 2.0};
  mine.wall_relief = {.height_m = dice.between(0.05, 0.1), .length_m = 1.5};
  mine.T_world_start = {1.0, 0.0, 0.0};
  return mine;
}

}  // namespace

CorridorMine random_corridor_mine(int seed, const std::string& kind) {
  Dice dice(static_cast<std::uint64_t>(seed));
  const double width_m = kind == "narrow" ? dice.between(1.7, 2.3) : dice.between(2.6, 4.5);
  CorridorMine mine{kind, bare_drift(seed, width_m, dice), {}};
  const double room_m = std::max(0.0, (width_m - 1.7) / 2.0);
  mine.across_m = dice.between(-1.0, 1.0) * std::min(room_m, 0.5);
  mine.heading_rad = dice.between(-0.15, 0.15);
  add_obstacles(mine, dice);
  return mine;
}

Corridor build_corridor(const CorridorMine& mine) {
  World world = build_world(mine.description);
  for (const AddThings& add : mine.things) add_things(world, add);
  Corridor corridor{mine.kind, drift_lines(mine.description.plan).front(), nullptr, {}, {}};
  corridor.site = std::make_unique<Site>(std::move(world));
  const auto station = corridor.drift.at(kCorridorStart);
  const Eigen::Vector2d p_world = corridor.drift.beside(kCorridorStart, mine.across_m);
  corridor.T_world_robot = {p_world.x(), p_world.y(), station.heading_rad + mine.heading_rad};
  corridor.T_world_body = standing(*corridor.site, corridor.T_world_robot);
  const Eigen::Vector2d way = corridor.drift.at(kCorridorStart + kAheadM).p_world - p_world;
  corridor.direction_rad = std::atan2(way.y(), way.x());
  return corridor;
}

Corridor random_corridor_with_robot(int seed, const Vehicle& vehicle, double room_m) {
  Vehicle larger = vehicle;
  larger.length_m += 2.0 * room_m;
  larger.width_m += 2.0 * room_m;
  const auto& kinds = corridor_kinds();
  const std::string& kind = kinds[static_cast<std::size_t>(seed) % kinds.size()];
  for (int i = 0; i < kTries; ++i) {
    try {
      Corridor corridor = build_corridor(random_corridor_mine(seed * kTries + i, kind));
      if (!touched_part(corridor.site->scene(), larger, corridor.T_world_body)) return corridor;
    } catch (const std::invalid_argument&) {  // it does not stand there
    }
  }
  throw std::invalid_argument("no corridor in which the vehicle stands");
}

}  // namespace adit
