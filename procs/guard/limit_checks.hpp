// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/sensing/vehicle_readings.hpp"

namespace adit {

/// The reason to stop for roll or pitch beyond the limit, in the conventions of Vehicle.
std::optional<std::string> tilt_reason(const Eigen::Vector3d& up_body, double tilt_max_rad);

/// Limits of the air, as shares of the volume, from the rules for coal mines in the United States:
/// - methane: at 1 % electrical equipment must be switched off (30 CFR 75.323);
/// - oxygen: at least 19.5 % where people work or travel (30 CFR 75.321);
/// - carbon monoxide: 50 ppm, the threshold limit value of 1972 that 30 CFR 75.322 refers to; a
///   sign of fire.
struct AirParams {
  double methane_max_share = 0.01;
  double oxygen_min_share = 0.195;
  double carbon_monoxide_max_share = 50e-6;

  template <class V>
  void visit(V& v) {
    v("methane_max_share", methane_max_share, within(0.0, 1.0));
    v("oxygen_min_share", oxygen_min_share, within(0.0, 1.0));
    v("carbon_monoxide_max_share", carbon_monoxide_max_share, within(0.0, 1.0));
  }
};

/// The reason to stop for the air: the first of methane, oxygen and carbon monoxide.
std::optional<std::string> air_reason(const GasReading& reading, const AirParams& params);

/// The reason to stop for sinkage: the deepest wheel.
std::optional<std::string> sinkage_reason(const SinkageReading& reading, double depth_max_m);

}  // namespace adit
