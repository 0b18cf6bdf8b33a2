// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/random/random_props.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "sim/world/drift_line.hpp"
#include "sim/world/random/topologies.hpp"

namespace adit {
namespace {

constexpr double kPlaceEvery = 12.0;  // what stands at one place reaches less far than this [m]
constexpr double kFromEnds = 4.0;     // places keep off the junctions at the ends of a drift [m]
constexpr double kPostsShare = 0.3;   // of the places without damage
constexpr double kRailsShare = 0.6;   // of the mines
constexpr double kReach = 5.0;        // of the largest prop from its place [m]

/// A place for a prop.
struct Place {
  const DriftLine& drift;
  double at_m;

  [[nodiscard]] double half_width_m() const { return drift.width_m / 2.0; }
};

double beside_wall(const Place& place, double from_wall_m, Dice& dice) {
  return dice.side() * std::max(0.0, place.half_width_m() - from_wall_m);
}

void add_posts(const Place& place, Dice& dice, PropDescriptions& props) {
  props.posts.push_back({.drift = place.drift.name,
                         .from_m = place.at_m - 3.0,
                         .to_m = place.at_m + 3.0,
                         .every_m = dice.between(1.5, 3.0),
                         .across_m = beside_wall(place, 0.35, dice),
                         .both_sides = place.drift.width_m > 3.5 && dice.chance(0.4)});
}

void add_crib(const Place& place, Dice& dice, PropDescriptions& props) {
  props.cribs.push_back({.drift = place.drift.name,
                         .at_m = place.at_m,
                         .across_m = beside_wall(place, 0.5, dice),
                         .side_m = dice.between(0.6, 1.0)});
}

void add_rubble(const Place& place, Dice& dice, PropDescriptions& props) {
  props.rubble.push_back({.drift = place.drift.name,
                          .at_m = place.at_m,
                          .across_m = dice.between(-1.0, 1.0) * place.half_width_m(),
                          .radius_m = dice.between(0.8, 2.5),
                          .height_m = dice.between(0.3, 2.0)});
}

void add_low_roof(const Place& place, Dice& dice, PropDescriptions& props) {
  const double half_m = dice.between(1.0, 3.5);
  props.low_roofs.push_back({.name = "low_roof_" + std::to_string(props.low_roofs.size() + 1),
                             .drift = place.drift.name,
                             .from_m = place.at_m - half_m,
                             .to_m = place.at_m + half_m,
                             .clearance_m = dice.between(0.6, 1.4)});
}

void add_pit(const Place& place, Dice& dice, PropDescriptions& props) {
  props.pits.push_back({.name = "pit_" + std::to_string(props.pits.size() + 1),
                        .drift = place.drift.name,
                        .at_m = place.at_m,
                        .across_m = dice.between(-0.8, 0.8) * place.half_width_m(),
                        .radius_m = dice.between(0.4, 1.2),
                        .depth_m = dice.between(0.4, 2.0)});
}

void add_water(const Place& place, Dice& dice, PropDescriptions& props) {
  const double half_m = dice.between(1.5, 3.8);
  props.water.push_back({.name = "water_" + std::to_string(props.water.size() + 1),
                         .drift = place.drift.name,
                         .from_m = place.at_m - half_m,
                         .to_m = place.at_m + half_m,
                         .depth_m = dice.between(0.1, 0.8),
                         .mirror = dice.chance(0.3)});
}

void add_mud(const Place& place, Dice& dice, PropDescriptions& props) {
  props.mud.push_back({.name = "mud_" + std::to_string(props.mud.size() + 1),
                       .drift = place.drift.name,
                       .at_m = place.at_m,
                       .radius_m = dice.between(1.0, 3.0),
                       .depth_m = dice.between(0.05, 0.3)});
}

void add_beam(const Place& place, Dice& dice, PropDescriptions& props) {
  props.beams.push_back({.drift = place.drift.name,
                         .at_m = place.at_m,
                         .thickness_m = dice.between(0.15, 0.3),
                         .yaw_rad = dice.between(-0.8, 0.8),
                         .high_end_m = dice.between(0.9, 1.5),
                         .cables = dice.between(0, 3),
                         .cable_sag_m = dice.between(0.3, 1.0)});
}

void add_car(const Place& place, Dice& dice, PropDescriptions& props) {
  props.cars.push_back({.drift = place.drift.name,
                        .at_m = place.at_m,
                        .across_m = dice.chance(0.5) ? 0.0 : beside_wall(place, 0.8, dice),
                        .width_m = dice.between(0.8, 1.1)});
}

void add_damage(const Place& place, Dice& dice, PropDescriptions& props) {
  using Add = void (*)(const Place&, Dice&, PropDescriptions&);
  // Falls are what damages mines most; cribs stand where one was feared.
  constexpr std::array<Add, 10> kKinds{add_rubble, add_rubble, add_rubble, add_crib, add_low_roof,
                                       add_pit,    add_water,  add_mud,    add_beam, add_car};
  const int kind = dice.between(0, static_cast<int>(kKinds.size()) - 1);
  kKinds[static_cast<std::size_t>(kind)](place, dice, props);
}

/// The drift behind the entrance is sound, and what leaves it begins behind that.
bool is_sound(const Place& place) {
  return place.drift.at(place.at_m).p_world.norm() < kSoundLength + kReach;
}

void add_rails(const DriftLine& main, PropDescriptions& props) {
  props.rails.push_back(
      {.drift = main.name, .from_m = 1.0, .to_m = main.length_m() - 2.0, .gauge_m = 0.6});
}

}  // namespace

PropDescriptions random_props(const PlanDescription& plan, double damage, Dice& dice) {
  PropDescriptions props;
  const std::vector<DriftLine> drifts = drift_lines(plan);
  if (dice.chance(kRailsShare)) add_rails(drifts.front(), props);
  for (const DriftLine& drift : drifts) {
    const double last_m = drift.length_m() - kFromEnds - kPlaceEvery / 2.0;
    for (double s_m = kFromEnds; s_m <= last_m; s_m += kPlaceEvery) {
      const Place place{drift, s_m + dice.between(4.0, 6.0)};
      const bool damaged = dice.chance(damage);
      const bool posts = dice.chance(kPostsShare);
      if (is_sound(place)) continue;
      if (damaged) {
        add_damage(place, dice, props);
      } else if (posts) {
        add_posts(place, dice, props);
      }
    }
  }
  return props;
}

}  // namespace adit
