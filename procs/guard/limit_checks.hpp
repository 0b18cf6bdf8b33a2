// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/sensing/vehicle_readings.hpp"

namespace adit {

/// Why a body that leans like that is to stand: pitch or roll beyond the limit, as Vehicle counts
/// them.
std::optional<std::string> tilt_reason(const Eigen::Vector3d& up_body, double tilt_max_rad);

/// What air is allowed, as shares of the volume. In the coal mines of the United States:
/// - methane: at 1 % electrical equipment is to be switched off (30 CFR 75.323);
/// - oxygen: at least 19.5 % where people work or travel (30 CFR 75.321);
/// - carbon monoxide: 50 ppm, the threshold limit value of 1972 that 30 CFR 75.322 refers to. It is
///   a sign of fire.
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

/// Why the vehicle is to stand in such air: the first of methane, oxygen, carbon monoxide.
std::optional<std::string> air_reason(const GasReading& reading, const AirParams& params);

/// Why it is to stand on such ground: its deepest wheel.
std::optional<std::string> sinkage_reason(const SinkageReading& reading, double depth_max_m);

}  // namespace adit
