// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "common/types/vehicle.hpp"
#include "common/types/vehicle_state.hpp"
#include "sim/vehicle/vehicle_params.hpp"

namespace adit {

/// Motors, brakes and steering: selects the active command and lets speed and curvature follow it.
///
/// Drive commands that are not finite or older than the last one are ignored; speed and curvature
/// are clamped to the vehicle's limits. A time in the future counts as now. Without a command
/// younger than the expiry, or under a stop order, the brakes are on and the steering is held. A
/// stop order takes effect whatever its time, since the clock of its sender may have jumped back;
/// only an order newer than all previous ones releases it. After the first order, orders must keep
/// arriving: otherwise their sender is assumed dead, and the vehicle stands until a valid order
/// arrives. If no order has ever arrived, drive commands alone control the vehicle.
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
  [[nodiscard]] bool stopped() const;
  [[nodiscard]] bool expired() const;

 private:
  [[nodiscard]] bool is_past(std::int64_t utime, double expiry_s) const;

  Vehicle vehicle_;
  VehicleModelParams params_;
  std::int64_t utime_;
  std::optional<DriveCommand> command_;
  std::optional<StopOrder> order_;
  std::int64_t order_received_utime_ = 0;  ///< by the vehicle's clock
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
