// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/worlds/corridor_obstacles.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "sim/world/props/prop_site.hpp"

namespace adit {
namespace {

// Nearest positions of tall and of low obstacles. Low ones nearer than 2.4 m are hidden below the
// steepest beam; a robot has observed that ground in earlier scans.
constexpr double kNearM = kCorridorStart + 1.8;
constexpr double kLowNearM = kCorridorStart + 2.4;
constexpr double kFarM = kCorridorStart + 7.0;

const char* const kTunnel = "main";

double width_m(const RandomCorridorMine& mine) { return mine.description.plan.tunnels[0].width_m; }
double anywhere_m(const RandomCorridorMine& mine, RandomGenerator& rng) {
  return rng.between(-0.5, 0.5) * width_m(mine);
}
double at_m(RandomGenerator& rng) { return rng.between(kNearM, kFarM); }
double low_at_m(RandomGenerator& rng) { return rng.between(kLowNearM, kFarM); }

/// Adds an object at a place in the tunnel: `add(builder, T_world_place, floor_m)`.
template <class Add>
void add_at(RandomCorridorMine& mine, double s_m, double across_m, const Add& add) {
  const TunnelLine tunnel = tunnel_lines(mine.description.plan).front();
  const Eigen::Vector2d p = tunnel.beside(s_m, across_m);
  const Pose2 place{p.x(), p.y(), tunnel.at(s_m).heading_rad};
  mine.objects.emplace_back([add, place](MeshBuilder& builder, const World& world) {
    add(builder, place, world.truth.floor_height(place.translation()).value_or(0.0));
  });
}

void nothing(RandomCorridorMine& /*mine*/, RandomGenerator& /*rng*/) {}

void posts(RandomCorridorMine& mine, RandomGenerator& rng) {
  const int n = rng.between(1, 6);
  for (int i = 0; i < n; ++i) {
    const double at = rng.between(kCorridorStart + 1.2, kFarM);
    mine.description.props.posts.push_back({.tunnel = kTunnel,
                                            .from_m = at,
                                            .to_m = at,
                                            .across_m = anywhere_m(mine, rng),
                                            .radius_m = rng.between(0.06, 0.15)});
  }
}

void cribs(RandomCorridorMine& mine, RandomGenerator& rng) {
  const int n = rng.between(1, 2);
  for (int i = 0; i < n; ++i) {
    mine.description.props.cribs.push_back({.tunnel = kTunnel,
                                            .at_m = at_m(rng),
                                            .across_m = anywhere_m(mine, rng),
                                            .side_m = rng.between(0.6, 1.0)});
  }
}

void fall(RandomCorridorMine& mine, RandomGenerator& rng) {
  const double radius_m = rng.between(0.6, 2.2);
  mine.description.props.rubble.push_back({.tunnel = kTunnel,
                                           .at_m = low_at_m(rng) + radius_m,
                                           .across_m = anywhere_m(mine, rng),
                                           .radius_m = radius_m,
                                           .height_m = rng.between(0.3, 1.8)});
}

void low_rubble(RandomCorridorMine& mine, RandomGenerator& rng) {
  const int n = rng.between(2, 6);
  for (int i = 0; i < n; ++i) {
    const double radius_m = rng.between(0.4, 1.5);
    mine.description.props.rubble.push_back({.tunnel = kTunnel,
                                             .at_m = low_at_m(rng) + radius_m,
                                             .across_m = anywhere_m(mine, rng),
                                             .radius_m = radius_m,
                                             .height_m = rng.between(0.05, 0.2)});
  }
}

void boulders(RandomCorridorMine& mine, RandomGenerator& rng) {
  const int n = rng.between(3, 25);
  const double largest_m = rng.between(0.08, 0.5);
  for (int i = 0; i < n; ++i) {
    const double radius_m = rng.between(0.2, 1.0) * largest_m;
    const int seed = rng.between(0, 1000000);
    const double at = low_at_m(rng) + radius_m;
    add_at(mine, at, anywhere_m(mine, rng),
           [=](MeshBuilder& builder, const Pose2& place, double floor) {
             std::mt19937_64 random(static_cast<std::uint64_t>(seed));
             builder.begin_part(PartKind::kRubble, Material::kRock, "boulder");
             add_stone({place.x, place.y, floor + 0.4 * radius_m}, radius_m, random, builder);
           });
  }
}

void rails(RandomCorridorMine& mine, RandomGenerator& rng) {
  mine.description.props.rails.push_back({.tunnel = kTunnel,
                                          .from_m = 1.0,
                                          .to_m = 22.0,
                                          .across_m = rng.between(-0.4, 0.4),
                                          .gauge_m = rng.chance(0.7) ? 0.6 : 0.9,
                                          .height_m = rng.between(0.06, 0.14)});
}

void broken_beam(RandomCorridorMine& mine, RandomGenerator& rng) {
  mine.description.props.beams.push_back({.tunnel = kTunnel,
                                          .at_m = low_at_m(rng) + 1.5,
                                          .thickness_m = rng.between(0.12, 0.3),
                                          .yaw_rad = rng.between(-0.7, 0.7),
                                          .high_end_m = rng.between(0.5, 1.7),
                                          .cables = rng.between(0, 3),
                                          .cable_diameter_m = rng.between(0.02, 0.03),
                                          .cable_sag_m = rng.between(0.3, 1.2)});
}

void hanging_beam(RandomCorridorMine& mine, RandomGenerator& rng) {
  const double thick_m = rng.between(0.08, 0.25);
  const double height_m = rng.between(0.4, 1.6);
  const double yaw = rng.between(-1.2, 1.2);
  const double tilt = rng.between(-0.4, 0.4);
  const double length_m = rng.between(0.8, 5.0);
  const double at = at_m(rng);
  add_at(mine, at, anywhere_m(mine, rng),
         [=](MeshBuilder& builder, const Pose2& place, double floor) {
           builder.begin_part(PartKind::kBeam, Material::kTimber, "hanging_beam");
           builder.box(plan_box(place * Pose2{0.0, 0.0, yaw}, floor + height_m,
                                {thick_m, length_m, thick_m}, tilt));
         });
}

void cables(RandomCorridorMine& mine, RandomGenerator& rng) {
  const int n = rng.between(1, 3);
  for (int i = 0; i < n; ++i) {
    const double half_m = width_m(mine) / 2.0 + 0.2;
    const double lowest_m = rng.between(0.15, 1.6);
    const double sag_m = rng.between(0.1, 0.8);
    const double slant_m = rng.between(-1.5, 1.5);
    const double diameter_m = rng.between(0.02, 0.03);
    add_at(mine, at_m(rng) + 1.0, 0.0, [=](MeshBuilder& builder, const Pose2& place, double floor) {
      const auto end = [&](double side) {
        const Eigen::Vector2d p = place * Eigen::Vector2d(side * slant_m, side * half_m);
        return Eigen::Vector3d(p.x(), p.y(), floor + lowest_m + sag_m);
      };
      add_cable(builder, end(-1.0), end(1.0), sag_m, diameter_m);
    });
  }
}

void low_roof(RandomCorridorMine& mine, RandomGenerator& rng) {
  const double from = at_m(rng);
  mine.description.props.low_roofs.push_back({.name = "low_roof",
                                              .tunnel = kTunnel,
                                              .from_m = from,
                                              .to_m = from + rng.between(0.5, 5.0),
                                              .clearance_m = rng.between(0.6, 1.6)});
}

/// A slab with a gentle slope that lowers the roof.
void sloping_roof(RandomCorridorMine& mine, RandomGenerator& rng) {
  const double length_m = rng.between(3.0, 8.0);
  const double pitch = rng.between(0.05, 0.25);
  const double lowest_m = rng.between(0.6, 1.5);
  add_at(mine, kCorridorStart + rng.between(5.0, 8.0), 0.0,
         [=](MeshBuilder& builder, const Pose2& place, double floor) {
           builder.begin_part(PartKind::kRoof, Material::kRock, "sloping_roof");
           const double middle_m = floor + lowest_m + 0.5 * length_m * std::sin(pitch) + 0.1;
           builder.box(
               plan_box(place * Pose2{0.0, 0.0, 1.5708}, middle_m, {8.0, length_m, 0.2}, pitch));
         });
}

void pit(RandomCorridorMine& mine, RandomGenerator& rng) {
  const int n = rng.between(1, 2);
  for (int i = 0; i < n; ++i) {
    const double radius_m = rng.between(0.4, 1.3);  // a wheel bridges smaller pits
    mine.description.props.pits.push_back({.name = "pit_" + std::to_string(i),
                                           .tunnel = kTunnel,
                                           .at_m = low_at_m(rng) + radius_m,
                                           .across_m = anywhere_m(mine, rng),
                                           .radius_m = radius_m,
                                           .depth_m = rng.between(0.25, 2.0)});
  }
}

/// A trench across the complete width of the tunnel, like a drainage ditch.
void trench(RandomCorridorMine& mine, RandomGenerator& rng) {
  // The floor is replaced by two slabs with a gap; the robot stands on the first one.
  const double depth_m = rng.between(0.08, 0.6);
  const double gap_m = rng.between(0.6, 1.5);  // a wheel bridges narrower gaps
  const double edge = rng.between(2.4, 6.0);
  add_at(mine, kCorridorStart, 0.0, [=](MeshBuilder& builder, const Pose2& place, double floor) {
    builder.begin_part(PartKind::kFloor, Material::kRock, "slab");
    builder.box(plan_box(place * Pose2{(edge - 5.0) / 2.0, 0.0, 0.0}, floor + depth_m - 0.5,
                         {edge + 5.0, 9.0, 1.0}));
    builder.begin_part(PartKind::kFloor, Material::kRock, "slab");
    builder.box(plan_box(place * Pose2{edge + gap_m + 4.0, 0.0, 0.0}, floor + depth_m - 0.5,
                         {8.0, 9.0, 1.0}));
  });
}

void water(RandomCorridorMine& mine, RandomGenerator& rng) {
  const double from = low_at_m(rng);
  mine.description.props.water.push_back({.name = "water",
                                          .tunnel = kTunnel,
                                          .from_m = from,
                                          .to_m = from + rng.between(1.0, 8.0),
                                          .depth_m = rng.between(0.1, 0.8),
                                          .mirror = rng.chance(0.3)});
}

void car(RandomCorridorMine& mine, RandomGenerator& rng) {
  mine.description.props.cars.push_back({.tunnel = kTunnel,
                                         .at_m = at_m(rng) + 1.0,
                                         .across_m = anywhere_m(mine, rng),
                                         .width_m = rng.between(0.8, 1.1)});
}

void ramp(RandomCorridorMine& mine, RandomGenerator& rng) {
  const double from = rng.between(kCorridorStart - 1.0, kFarM);
  const double rise = rng.side() * rng.between(0.05, 0.6);
  const double length_m = rng.between(2.0, 5.0);
  mine.description.heights.profile_m = {0.0, 0.0, from, 0.0, from + length_m, rise * length_m};
}

/// A step up, or a step down at the end of a slab on which the robot stands.
void step(RandomCorridorMine& mine, RandomGenerator& rng) {
  const double height_m = rng.between(0.06, 0.4);
  const bool down = rng.chance(0.5);
  const double edge = rng.between(2.4, 6.0);
  const double length_m = down ? 7.0 : 10.0;
  add_at(mine, kCorridorStart, 0.0, [=](MeshBuilder& builder, const Pose2& place, double floor) {
    const double middle = down ? edge - length_m / 2.0 : edge + length_m / 2.0;
    builder.begin_part(PartKind::kFloor, Material::kRock, "slab");
    builder.box(
        plan_box(place * Pose2{middle, 0.0, 0.0}, floor + height_m - 0.5, {length_m, 9.0, 1.0}));
  });
}

/// Two blocks with a gap between them.
void pinch(RandomCorridorMine& mine, RandomGenerator& rng) {
  const double gap_m = rng.between(1.4, 2.4);
  const double middle_m = rng.between(-0.5, 0.5) * std::max(0.0, width_m(mine) - gap_m);
  const double length_m = rng.between(0.2, 2.0);
  const double yaw = rng.between(-0.3, 0.3);
  add_at(
      mine, at_m(rng) + 0.5, middle_m, [=](MeshBuilder& builder, const Pose2& place, double floor) {
        for (const double side : {-1.0, 1.0}) {
          builder.begin_part(PartKind::kWall, Material::kRock, "block");
          builder.box(
              plan_box(place * Pose2{0.0, 0.0, yaw} * Pose2{0.0, side * (gap_m / 2.0 + 2.0), 0.0},
                       floor + 0.7, {length_m, 4.0, 1.6}));
        }
      });
}

void side_tunnel(RandomCorridorMine& mine, RandomGenerator& rng) {
  const TunnelLine tunnel = tunnel_lines(mine.description.plan).front();
  const auto station = tunnel.at(rng.between(kCorridorStart - 1.0, kFarM + 2.0));
  const Pose2 place{station.p_world.x(), station.p_world.y(), station.heading_rad};
  const Eigen::Vector2d end = place * Eigen::Vector2d(rng.between(-3.0, 3.0), rng.side() * 9.0);
  mine.description.plan.tunnels.push_back({.name = "side",
                                           .points_m = {place.x, place.y, end.x(), end.y()},
                                           .width_m = rng.between(2.4, 3.5)});
}

void mud(RandomCorridorMine& mine, RandomGenerator& rng) {
  mine.description.props.mud.push_back({.name = "mud",
                                        .tunnel = kTunnel,
                                        .at_m = at_m(rng),
                                        .radius_m = rng.between(1.0, 3.0),
                                        .depth_m = rng.between(0.02, 0.06)});
}

using Add = void (*)(RandomCorridorMine&, RandomGenerator&);
constexpr std::array<std::pair<const char*, Add>, 20> kKinds{{{"free", nothing},
                                                              {"posts", posts},
                                                              {"cribs", cribs},
                                                              {"fall", fall},
                                                              {"low_rubble", low_rubble},
                                                              {"boulders", boulders},
                                                              {"rails", rails},
                                                              {"broken_beam", broken_beam},
                                                              {"hanging_beam", hanging_beam},
                                                              {"cables", cables},
                                                              {"low_roof", low_roof},
                                                              {"sloping_roof", sloping_roof},
                                                              {"pit", pit},
                                                              {"trench", trench},
                                                              {"water", water},
                                                              {"car", car},
                                                              {"ramp", ramp},
                                                              {"step", step},
                                                              {"pinch", pinch},
                                                              {"narrow", nothing}}};

}  // namespace

const std::vector<std::string>& corridor_kinds() {
  static const std::vector<std::string> kinds = [] {
    std::vector<std::string> names;
    for (const auto& [name, add] : kKinds) names.emplace_back(name);
    return names;
  }();
  return kinds;
}

void add_obstacles(RandomCorridorMine& mine, RandomGenerator& rng) {
  for (const auto& [name, add] : kKinds) {
    if (mine.kind == name) add(mine, rng);
  }
  const bool slabs = mine.kind == "step" || mine.kind == "trench";  // slabs would bury low objects
  if (!slabs && mine.kind != "rails" && rng.chance(0.25)) rails(mine, rng);
  if (rng.chance(0.25)) side_tunnel(mine, rng);
  if (rng.chance(0.1)) mud(mine, rng);
  if (!slabs && rng.chance(0.15)) low_rubble(mine, rng);
  if (rng.chance(0.25)) {
    const double beside_m = std::max(0.0, width_m(mine) / 2.0 - 0.3);
    mine.description.props.posts.push_back({.tunnel = kTunnel,
                                            .from_m = 2.0,
                                            .to_m = 20.0,
                                            .every_m = rng.between(1.5, 4.0),
                                            .across_m = rng.side() * beside_m});
  }
}

}  // namespace adit
