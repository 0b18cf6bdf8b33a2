// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "common/vehicle/vehicle.hpp"
#include "sim/vehicle/vehicle_params.hpp"

namespace adit {

/// A charge that computers draw from all the time, and motors in proportion to the speed.
class Battery {
 public:
  Battery(const Vehicle& vehicle, const VehicleModelParams& params)
      : params_(params), speed_max_m_s_(vehicle.speed_max_m_s), energy_wh_(params.battery_wh) {}

  void draw(double speed_m_s, double seconds) {
    const double drive_w = params_.power_drive_w * std::abs(speed_m_s) / speed_max_m_s_;
    energy_wh_ = std::max(0.0, energy_wh_ - (params_.power_idle_w + drive_w) * seconds / 3600.0);
  }

  [[nodiscard]] double share() const { return energy_wh_ / params_.battery_wh; }
  [[nodiscard]] bool empty() const { return energy_wh_ == 0.0; }

 private:
  VehicleModelParams params_;
  double speed_max_m_s_;
  double energy_wh_;
};

}  // namespace adit
