// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include "common/vehicle/vehicle.hpp"
#include "sim/mesh/ray_scene.hpp"

namespace adit {

/// Where a wheel is, and from which height to look down for ground.
struct WheelPlace {
  Eigen::Vector2d p_world{0.0, 0.0};  ///< middle of the wheel [m]
  double heading_rad = 0.0;
  double look_from_m = 0.0;  ///< z in world
};

/// The ground under one wheel.
struct WheelGround {
  double height_m = 0.0;       ///< z of the lowest point of a wheel that rests on it, in world
  std::uint32_t triangle = 0;  ///< on which it rests

  double step_m = 0.0;              ///< greatest change of height along 0.6 of a wheel radius
  std::uint32_t step_triangle = 0;  ///< the upper side of it
};

/// Looks for the ground under wheels with rays, five along by five across each wheel, so that no
/// rail slips between two: a wheel is a cylinder that rests on the highest of what they meet.
class WheelGroundProbe {
 public:
  /// `scene` must outlive this.
  WheelGroundProbe(const RayScene& scene, const Vehicle& vehicle);

  /// Nothing where there is no ground below the middle of the wheel.
  [[nodiscard]] std::optional<WheelGround> under(const WheelPlace& place) const;

 private:
  const RayScene& scene_;
  double wheel_radius_m_;
  double wheel_width_m_;
};

}  // namespace adit
