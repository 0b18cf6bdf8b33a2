// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include <Eigen/Geometry>

#include "common/geometry/pose2.hpp"
#include "common/vehicle/vehicle.hpp"
#include "sim/vehicle/wheel_ground.hpp"
#include "sim/world/world.hpp"

namespace adit {

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
  Fault look_for_ground(const Pose2& T_world_plan, double change_max_m);
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
