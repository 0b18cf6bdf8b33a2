// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/geometry/pose2.hpp"
#include "common/types/vehicle.hpp"
#include "sim/mesh/ray_scene.hpp"
#include "sim/world/world.hpp"

namespace adit {

/// Where a wheel is, and from which height to look down for ground.
struct WheelPlace {
  Eigen::Vector2d p_world{0.0, 0.0};  ///< middle of the wheel [m]
  double heading_rad = 0.0;
  double cast_from_m = 0.0;  ///< z in world
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

/// How four wheels on the ground hold the body: height, roll and pitch are those of the plane
/// nearest to their lowest points (least squares), which may lie below the surface of soft ground.
/// Wheels are numbered front left, front right, rear left, rear right.
class Stance {
 public:
  /// Why the vehicle does not stand: no ground under a wheel, a step that is too high for one, one
  /// that is sunk in too deep, or too much roll or pitch. Nothing where it stands.
  using Fault = std::optional<std::string>;

  /// `site` must outlive this.
  Stance(const Site& site, const Vehicle& vehicle);

  /// Puts the vehicle on a floor at a height, wherever it was before.
  Fault put(const Pose2& T_world_plan, double floor_m);

  /// Moves it on by a small distance. A wheel rises and falls by no more than it moves.
  Fault move(const Pose2& T_world_plan);

  [[nodiscard]] const Eigen::Isometry3d& T_world_body() const { return T_world_body_; }
  [[nodiscard]] const std::array<double, 4>& sinkage_m() const { return sinkage_m_; }

 private:
  [[nodiscard]] Eigen::Vector3d p_body_wheel(std::size_t wheel) const;
  [[nodiscard]] Eigen::Vector2d p_world_wheel(std::size_t wheel, const Pose2& T_world_plan) const;
  /// `change_max_m` is how far the ground under a wheel may have risen or fallen since the last
  /// look.
  Fault find_ground(const Pose2& T_world_plan, double change_max_m);
  Fault sink(const Pose2& T_world_plan);
  void fit_plane(const Pose2& T_world_plan);
  [[nodiscard]] Fault check_tilt() const;

  const Site& site_;
  Vehicle vehicle_;
  WheelGroundProbe probe_;
  Eigen::Isometry3d T_world_body_ = Eigen::Isometry3d::Identity();
  std::array<double, 4> ground_m_{};   ///< where each wheel would rest, z in world
  std::array<double, 4> contact_m_{};  ///< where it is on its way there
  std::array<double, 4> sinkage_m_{};
};

}  // namespace adit
