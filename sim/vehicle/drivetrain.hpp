// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "common/types/drive_orders.hpp"
#include "common/types/vehicle.hpp"
#include "common/types/vehicle_state.hpp"
#include "sim/vehicle/vehicle_params.hpp"

namespace adit {

/// Motors, brakes and steering: lets speed and curvature follow the drive command in effect
/// (DriveOrders), clamped to the vehicle's limits. Without one the brakes are on and the steering
/// is held.
class Drivetrain {
 public:
  Drivetrain(const Vehicle& vehicle, const VehicleModelParams& params, std::int64_t utime);

  void command(const DriveCommand& command);
  void command(const StopOrder& order);

  /// Advances time.
  void advance(double seconds);
  /// Stops the wheels immediately, as an obstacle does.
  void halt() { speed_m_s_ = 0.0; }

  [[nodiscard]] std::int64_t utime() const { return utime_; }
  [[nodiscard]] double speed_m_s() const { return speed_m_s_; }
  /// Of the path of the body's origin.
  [[nodiscard]] double curvature_1_m() const { return curvature_1_m_; }
  /// Distance that the wheels rolled in the last advance(), along the body's x axis.
  [[nodiscard]] double wheel_distance_m() const { return wheel_distance_m_; }
  /// Stopped by an order, or because orders timed out.
  [[nodiscard]] bool stopped() const { return orders_.stopped(utime_); }
  [[nodiscard]] bool expired() const { return orders_.expired(utime_); }

 private:
  Vehicle vehicle_;
  VehicleModelParams params_;
  std::int64_t utime_;
  DriveOrders orders_;
  double speed_m_s_ = 0.0;
  double curvature_1_m_ = 0.0;
  double wheel_distance_m_ = 0.0;
};

/// A charge that computers draw from all the time, and motors for what they do against rolling
/// resistance and slope:
///   P = P_idle + max(0, m g (c |v| cos α + v sin α)) / η
/// at the speed v on ground that rises by α ahead (Wong, "Theory of Ground Vehicles", section 3.1,
/// without drag and acceleration). There is no recuperation.
class Battery {
 public:
  Battery(const Vehicle& vehicle, const VehicleModelParams& params)
      : mass_kg_(vehicle.mass_kg), params_(params), energy_wh_(params.battery_wh) {}

  /// `rise` is sin α.
  void draw(double speed_m_s, double rise, double seconds);

  [[nodiscard]] double share() const { return energy_wh_ / params_.battery_wh; }
  [[nodiscard]] bool empty() const { return energy_wh_ == 0.0; }

 private:
  double mass_kg_;
  VehicleModelParams params_;
  double energy_wh_;
};

}  // namespace adit
