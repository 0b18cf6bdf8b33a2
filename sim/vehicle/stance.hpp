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

/// Pose of a wheel in the plan, and the height from which rays are cast down.
struct WheelPlace {
  Eigen::Vector2d p_world{0.0, 0.0};  ///< middle of the wheel [m]
  double heading_rad = 0.0;
  double cast_from_m = 0.0;  ///< z in world
  double grade_ahead = 0.0;  ///< of the plane on which the vehicle stands, along the heading [m/m]
};

/// The ground under one wheel.
struct WheelGround {
  double height_m = 0.0;       ///< z of the lowest point of a wheel that rests on it, in world
  std::uint32_t triangle = 0;  ///< that supports the wheel

  double step_m = 0.0;              ///< greatest step, vertical, along 0.6 of a wheel radius
  std::uint32_t step_triangle = 0;  ///< on the upper side of the step
};

/// Finds the ground under wheels with a grid of 5 × 5 rays for each wheel, dense enough that no
/// rail passes between two. A wheel is a cylinder that rests on the highest hit. A step is a change
/// of height beyond the slope of the ground: of the grades of the plane on which the vehicle stands
/// and of the surfaces above and below the step the least, so that a plane has no step and a step
/// on a slope has the height of its face.
class WheelGroundProbe {
 public:
  /// `scene` must outlive this.
  WheelGroundProbe(const RayScene& scene, const Vehicle& vehicle);

  /// Empty if there is no ground below the middle of the wheel.
  [[nodiscard]] std::optional<WheelGround> under(const WheelPlace& place) const;

 private:
  const RayScene& scene_;
  double wheel_radius_m_;
  double wheel_width_m_;
};

/// Pose of the body on its four wheels: height, roll and pitch are those of the least-squares plane
/// through their lowest points, which lie below the surface on soft ground. Order of the wheels:
/// front left, front right, rear left, rear right.
class Stance {
 public:
  /// Why the vehicle cannot stand: no ground under a wheel, a step or a sinkage beyond the limit,
  /// or too much roll or pitch. Empty if it stands.
  using Fault = std::optional<std::string>;

  /// `site` must outlive this.
  Stance(const Site& site, const Vehicle& vehicle);

  /// Places the vehicle on a floor at a height, independent of its previous pose.
  Fault put(const Pose2& T_world_plan, double floor_m);

  /// Moves the vehicle by a small distance. A wheel rises or falls by at most the distance that it
  /// moves.
  Fault move(const Pose2& T_world_plan);

  [[nodiscard]] const Eigen::Isometry3d& T_world_body() const { return T_world_body_; }
  [[nodiscard]] const std::array<double, 4>& sinkage_m() const { return sinkage_m_; }

 private:
  [[nodiscard]] Eigen::Vector3d p_body_wheel(std::size_t wheel) const;
  [[nodiscard]] Eigen::Vector2d p_world_wheel(std::size_t wheel, const Pose2& T_world_plan) const;
  [[nodiscard]] double grade_ahead() const;
  /// `change_max_m` limits the change of the ground's height under a wheel since the last call.
  Fault find_ground(const Pose2& T_world_plan, double change_max_m);
  Fault sink(const Pose2& T_world_plan);
  void fit_plane(const Pose2& T_world_plan);
  [[nodiscard]] Fault check_tilt() const;

  const Site& site_;
  Vehicle vehicle_;
  WheelGroundProbe probe_;
  Eigen::Isometry3d T_world_body_ = Eigen::Isometry3d::Identity();
  std::array<double, 4> ground_m_{};   ///< support height of each wheel, z in world
  std::array<double, 4> contact_m_{};  ///< current height, which approaches ground_m_
  std::array<double, 4> sinkage_m_{};
};

}  // namespace adit
