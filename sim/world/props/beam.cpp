// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "sim/world/props/prop_site.hpp"

namespace adit {
namespace {

constexpr double kIntoWall = 0.1;       // how far the ends go behind the plan of the walls [m]
constexpr double kCableSpan = 5.0;      // length of a cable between its ends at the roof [m]
constexpr double kCableSegment = 0.05;  // [m]

/// A box of square section from one point to another.
OrientedBox timber_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                           double thickness_m) {
  const Eigen::Vector3d along = (to - from).normalized();
  const Eigen::Vector3d aside = Eigen::Vector3d::UnitZ().cross(along).normalized();
  OrientedBox box;
  box.T_world_box.translation() = (from + to) / 2.0;
  box.T_world_box.linear() << along, aside, along.cross(aside);
  box.half_size = {(to - from).norm() / 2.0, thickness_m / 2.0, thickness_m / 2.0};
  return box;
}

/// The centre of the lower end is half a thickness above the floor, that of the upper end at the
/// described height.
void add_timber(const BeamDescription& beam, const TunnelLine& tunnel, PropSite& site) {
  const double half_m = (tunnel.width_m / 2.0 + kIntoWall);
  const double along_m = half_m * std::tan(beam.yaw_rad);
  const Eigen::Isometry3d T_world_axes =
      tunnel_axes(tunnel, beam.at_m, on_floor(site, tunnel, beam.at_m, 0.0));
  const auto end = [&](double side, double above_m) {
    Eigen::Vector3d p_world = T_world_axes * Eigen::Vector3d(-side * along_m, side * half_m, 0.0);
    p_world.z() = site.heights.floor(p_world.head<2>()) + above_m;
    return p_world;
  };
  const std::size_t first = begin_obstacle(site, PartKind::kBeam, Material::kTimber, "beam");
  site.builder.box(timber_between(end(-1.0, beam.thickness_m / 2.0), end(1.0, beam.high_end_m),
                                  beam.thickness_m));
  end_obstacle(site, first);
}

/// A parabola between two points of the roof, which approximates a catenary of little sag. `lane`
/// is from −1, at the right wall, to 1.
void add_cable(const BeamDescription& beam, const TunnelLine& tunnel, double lane, PropSite& site) {
  const auto at_roof = [&](double side) {
    const double across_m = (lane + site.between(-0.35, 0.35)) * tunnel.width_m / 2.0;
    const Eigen::Vector2d plan = tunnel.beside(beam.at_m + side * kCableSpan / 2.0, across_m);
    return Eigen::Vector3d(plan.x(), plan.y(), site.heights.roof(plan));
  };
  const Eigen::Vector3d from = at_roof(-1.0);
  const Eigen::Vector3d to = at_roof(1.0);
  std::vector<Eigen::Vector3d> line;
  for (const double share : places_between(0.0, 1.0, kCableSegment / kCableSpan)) {
    const double below_m = 4.0 * beam.cable_sag_m * share * (1.0 - share);
    line.emplace_back(from + share * (to - from) - below_m * Eigen::Vector3d::UnitZ());
  }
  const std::size_t first = begin_obstacle(site, PartKind::kCable, Material::kSteel, "cable");
  site.builder.tube(line, beam.cable_diameter_m / 2.0);
  end_obstacle(site, first);
}

}  // namespace

void add_prop(const BeamDescription& beam, PropSite& site) {
  const TunnelLine& tunnel = tunnel_with(site.tunnels, beam.tunnel, beam.at_m, site.what);
  add_timber(beam, tunnel, site);
  for (int i = 0; i < beam.cables; ++i) {
    add_cable(beam, tunnel, -0.6 + 1.2 * (i + 0.5) / beam.cables, site);
  }
}

}  // namespace adit
