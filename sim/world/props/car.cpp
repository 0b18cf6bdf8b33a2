// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "sim/world/props/prop_site.hpp"

namespace adit {
namespace {

constexpr double kPlate = 0.04;        // thickness of the body's sides [m]
constexpr double kWheelWidth = 0.06;   // [m]
constexpr double kWheelRadius = 0.18;  // at most [m]

/// A box by its minimum and maximum corner in the frame of the car.
void add_plate(const Eigen::Isometry3d& T_world_car, const Eigen::Vector3d& low,
               const Eigen::Vector3d& high, MeshBuilder& builder) {
  OrientedBox box;
  box.T_world_box = T_world_car;
  box.T_world_box.translate((low + high) / 2.0);
  box.half_size = (high - low) / 2.0;
  builder.box(box);
}

/// An open tub whose bottom is at `bottom_m`.
void add_tub(const CarDescription& car, const Eigen::Isometry3d& T_world_car, double bottom_m,
             MeshBuilder& builder) {
  const double x = car.length_m / 2.0;
  const double y = car.width_m / 2.0;
  const double top_m = car.height_m;
  add_plate(T_world_car, {-x, -y, bottom_m}, {x, y, bottom_m + kPlate}, builder);
  add_plate(T_world_car, {-x, -y, bottom_m}, {x, -y + kPlate, top_m}, builder);
  add_plate(T_world_car, {-x, y - kPlate, bottom_m}, {x, y, top_m}, builder);
  add_plate(T_world_car, {-x, -y, bottom_m}, {-x + kPlate, y, top_m}, builder);
  add_plate(T_world_car, {x - kPlate, -y, bottom_m}, {x, y, top_m}, builder);
}

void add_wheel(const Eigen::Isometry3d& T_world_car, double x, double y, double radius_m,
               MeshBuilder& builder) {
  const Eigen::Vector3d inner(x, y - kWheelWidth / 2.0, radius_m);
  const Eigen::Vector3d outer(x, y + kWheelWidth / 2.0, radius_m);
  builder.bar(T_world_car * inner, T_world_car * outer, radius_m, 16);
}

}  // namespace

void add_prop(const CarDescription& car, PropSite& site) {
  const TunnelLine& tunnel = tunnel_with(site.tunnels, car.tunnel, car.at_m, site.what);
  const double radius_m = std::min(kWheelRadius, car.height_m / 4.0);
  const Eigen::Isometry3d T_world_car =
      tunnel_axes(tunnel, car.at_m, on_floor(site, tunnel, car.at_m, car.across_m));

  const std::size_t first = begin_obstacle(site, PartKind::kCar, Material::kSteel, "car");
  add_tub(car, T_world_car, 1.5 * radius_m, site.builder);
  for (const double x : {-0.28 * car.length_m, 0.28 * car.length_m}) {
    for (const double y : {-0.35 * car.width_m, 0.35 * car.width_m}) {
      add_wheel(T_world_car, x, y, radius_m, site.builder);
    }
  }
  end_obstacle(site, first);
}

}  // namespace adit
