// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/types/vehicle.hpp"
#include "sim/vehicle/vehicle_params.hpp"

namespace adit {

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
