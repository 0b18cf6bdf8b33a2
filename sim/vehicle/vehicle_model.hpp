// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <random>
#include <string>

#include <Eigen/Geometry>

#include "common/vehicle/drive_command.hpp"
#include "common/vehicle/vehicle.hpp"
#include "sim/vehicle/vehicle_params.hpp"
#include "sim/world/world.hpp"

namespace adit {

/// Where the body truly is and how it moves.
struct BodyMotion {
  std::int64_t utime = 0;  ///< [µs since the epoch]
  Eigen::Isometry3d T_world_body = Eigen::Isometry3d::Identity();
  Eigen::Vector3d v_body{0.0, 0.0, 0.0};      ///< velocity, in the body frame [m/s]
  Eigen::Vector3d omega_body{0.0, 0.0, 0.0};  ///< angular velocity, in the body frame [rad/s]
};

/// The vehicle on the ground of a site: steering and speed with their limits, slip, four wheels
/// that follow the relief and sink into soft ground, a battery. A collision, a wheel over the step
/// limit, a fall, a roll, deep water, mud that holds it or an empty battery end the run for good;
/// the vehicle then stands where that happened.
class VehicleModel {
 public:
  /// `site` must outlive this. Throws std::invalid_argument where the vehicle cannot stand at the
  /// start, with the reason.
  VehicleModel(const Site& site, const Vehicle& vehicle, const VehicleModelParams& params,
               std::uint64_t seed, std::int64_t utime);

  void command(const DriveCommand& command);
  void command(const StopOrder& order);

  /// Lets time go on, by one integration step (10 ms at most).
  void advance(double seconds);

  [[nodiscard]] const BodyMotion& motion() const { return motion_; }
  /// As the vehicle says itself: of the wheels, slip not known.
  [[nodiscard]] VehicleState state() const;
  [[nodiscard]] const std::array<double, 4>& sinkage_m() const { return sinkage_m_; }
  [[nodiscard]] double travelled_m() const { return travelled_m_; }

  /// Why the run is over; nothing while it is not.
  [[nodiscard]] const std::optional<std::string>& failure() const { return failure_; }

 private:
  const Site& site_;
  Vehicle vehicle_;
  VehicleModelParams params_;
  std::mt19937_64 random_;
  BodyMotion motion_;
  std::array<double, 4> sinkage_m_{};
  double travelled_m_ = 0.0;
  std::optional<std::string> failure_;
};

}  // namespace adit
