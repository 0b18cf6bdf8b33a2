// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "common/types/vehicle.hpp"
#include "common/types/vehicle_state.hpp"
#include "sim/vehicle/vehicle_params.hpp"

namespace adit {

/// Motors, brakes and steering: which command is in force, and how speed and curvature follow it.
///
/// A drive command that is not finite is ignored, as is one that is older than the last; speed and
/// curvature beyond what the vehicle can do are clamped. A time that is yet to come counts as now.
/// Without a command younger than the expiry, or under a stop order, the brakes are on and the
/// steering stays as it is. A stop order counts however old it is, since who gave it may have a
/// clock that went back, and holds until an order that is newer than all before releases it. Once
/// an order has come, orders must go on coming: who gives them is dead or hangs otherwise, and the
/// vehicle stands until one that counts comes again. Without any ever it drives as it is told.
class Drivetrain {
 public:
  Drivetrain(const Vehicle& vehicle, const VehicleModelParams& params, std::int64_t utime);

  void command(const DriveCommand& command);
  void command(const StopOrder& order);

  /// Lets time go on.
  void advance(double seconds);
  /// The wheels come to a stand at once, as against a wall.
  void halt() { speed_m_s_ = 0.0; }

  [[nodiscard]] std::int64_t utime() const { return utime_; }
  [[nodiscard]] double speed_m_s() const { return speed_m_s_; }
  /// Of the path of the body's origin.
  [[nodiscard]] double curvature_1_m() const { return curvature_1_m_; }
  /// By which the wheels turned in the last advance, along the body's x axis.
  [[nodiscard]] double wheel_distance_m() const { return wheel_distance_m_; }
  /// By a stop order, or because they no longer come.
  [[nodiscard]] bool stopped() const;
  [[nodiscard]] bool expired() const;

 private:
  [[nodiscard]] bool is_past(std::int64_t utime, double expiry_s) const;

  Vehicle vehicle_;
  VehicleModelParams params_;
  std::int64_t utime_;
  std::optional<DriveCommand> command_;
  std::optional<StopOrder> order_;
  std::int64_t order_received_utime_ = 0;  ///< by the own clock
  double speed_m_s_ = 0.0;
  double curvature_1_m_ = 0.0;
  double wheel_distance_m_ = 0.0;
};

}  // namespace adit
