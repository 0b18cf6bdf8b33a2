// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include <Eigen/Geometry>

#include "common/types/vehicle.hpp"
#include "common/types/vehicle_state.hpp"
#include "sim/vehicle/drivetrain.hpp"
#include "sim/vehicle/kinematics.hpp"
#include "sim/vehicle/stance.hpp"
#include "sim/vehicle/vehicle_params.hpp"
#include "sim/world/world.hpp"

namespace adit {

/// True pose and velocity of the body.
struct BodyMotion {
  std::int64_t utime = 0;  ///< [µs since the epoch]
  Eigen::Isometry3d T_world_body = Eigen::Isometry3d::Identity();
  Eigen::Vector3d v_body{0.0, 0.0, 0.0};      ///< velocity, in the body frame [m/s]
  Eigen::Vector3d omega_body{0.0, 0.0, 0.0};  ///< angular velocity, in the body frame [rad/s]
};

/// The vehicle on the ground of a site: limits of steering and speed, slip, four wheels that follow
/// the relief and sink into soft ground, a battery. A collision, a step above the limit, missing
/// ground, too much tilt, deep water, too much sinkage or an empty battery end the run permanently;
/// the vehicle then stands at that pose.
class VehicleModel {
 public:
  /// `site` must outlive this. Throws std::invalid_argument with the reason if the vehicle cannot
  /// stand at the start.
  VehicleModel(const Site& site, const Vehicle& vehicle, const VehicleModelParams& params,
               std::uint64_t seed, std::int64_t utime);

  /// Validation, clamping and expiry of commands: see Drivetrain.
  void command(const DriveCommand& command) { drivetrain_.command(command); }
  void command(const StopOrder& order) { drivetrain_.command(order); }

  /// Advances time by one integration step (10 ms at most).
  void advance(double seconds);

  /// Velocities are the means over the last step.
  [[nodiscard]] const BodyMotion& motion() const { return motion_; }
  /// As measured by the vehicle: speed of the wheels, without slip.
  [[nodiscard]] VehicleState state() const;
  /// Front left, front right, rear left, rear right.
  [[nodiscard]] const std::array<double, 4>& sinkage_m() const { return stance_.sinkage_m(); }
  /// Distance travelled by the body's origin over ground, in either direction.
  [[nodiscard]] double distance_travelled_m() const { return distance_travelled_m_; }

  /// Why the run has failed; empty if it has not.
  [[nodiscard]] const std::optional<std::string>& failure() const { return failure_; }

 private:
  void move(double seconds);
  [[nodiscard]] double rise_ahead() const;
  [[nodiscard]] Pose2 next_place() const;
  std::optional<std::string> check_surroundings();
  void fail(const std::string& reason);
  void stand();

  const Site& site_;
  Vehicle vehicle_;
  Steering steering_;
  Drivetrain drivetrain_;
  WheelSlip slip_;
  Stance stance_;
  Battery battery_;
  Pose2 T_world_plan_;
  BodyMotion motion_;
  double distance_travelled_m_ = 0.0;
  double unchecked_m_ = 0.0;  ///< distance of the outermost points since the last collision check
  std::optional<std::string> failure_;
};

}  // namespace adit
