// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/vehicle/battery.hpp"

#include <algorithm>
#include <cmath>

#include "sim/vehicle/vehicle_params.hpp"

namespace adit {

void Battery::draw(double speed_m_s, double rise, double seconds) {
  const double rolling = params_.rolling_resistance * std::sqrt(1.0 - rise * rise);
  const double lifting_m_s = rolling * std::abs(speed_m_s) + rise * speed_m_s;
  const double wheels_w = mass_kg_ * kGravityM_S2 * std::max(0.0, lifting_m_s);
  const double drawn_w = params_.power_idle_w + wheels_w / params_.drive_efficiency;
  energy_wh_ = std::max(0.0, energy_wh_ - drawn_w * seconds / 3600.0);
}

}  // namespace adit
