// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <numbers>

#include "sim/world/props/add_prop.hpp"
#include "sim/world/props/placement.hpp"

namespace adit {
namespace {

constexpr double kTimber = 0.15;  // side of the section of a timber [m]

/// Two timbers side by side, the layer's middle at `T_world_layer`, along its x.
void add_layer(const Eigen::Isometry3d& T_world_layer, double side_m, MeshBuilder& builder) {
  for (const double side : {-1.0, 1.0}) {
    OrientedBox timber;
    timber.T_world_box = T_world_layer;
    timber.T_world_box.translate(Eigen::Vector3d(0.0, side * (side_m - kTimber) / 2.0, 0.0));
    timber.half_size = {side_m / 2.0, kTimber / 2.0, kTimber / 2.0};
    builder.box(timber);
  }
}

}  // namespace

void add_prop(const CribDescription& crib, PropSite& site) {
  const DriftLine& drift = drift_with(site.drifts, crib.drift, crib.at_m, site.what);
  const Eigen::Vector3d foot = on_floor(site, drift, crib.at_m, crib.across_m);
  const double roof_m = site.heights.roof(foot.head<2>());

  const std::size_t first = begin_obstacle(site, PartKind::kCrib, Material::kTimber, "crib");
  Eigen::Isometry3d T_world_layer = drift_axes(drift, crib.at_m, foot);
  T_world_layer.rotate(Eigen::AngleAxisd(site.between(-0.2, 0.2), Eigen::Vector3d::UnitZ()));
  // The lowest layer is sunk by half, and the uppermost is wedged into the roof.
  while (T_world_layer.translation().z() < roof_m) {
    add_layer(T_world_layer, crib.side_m, site.builder);
    T_world_layer.translate(Eigen::Vector3d(0.0, 0.0, kTimber));
    T_world_layer.rotate(Eigen::AngleAxisd(std::numbers::pi / 2.0 + site.between(-0.02, 0.02),
                                           Eigen::Vector3d::UnitZ()));
  }
  end_obstacle(site, first);
}

}  // namespace adit
