// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/limit_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "procs/guard/attitude.hpp"
#include "procs/guard/decimal_text.hpp"

namespace adit {
namespace {

std::optional<std::string> limit_reason(const char* name, double angle_rad, double max_rad) {
  if (!(std::abs(angle_rad) > max_rad)) return std::nullopt;
  return std::string(name) + " of " + decimal_text(angle_rad, 2) + " rad, limit " +
         decimal_text(max_rad, 2) + " rad";
}

}  // namespace

std::optional<std::string> tilt_reason(const Eigen::Vector3d& up_body, double tilt_max_rad) {
  if (auto roll = limit_reason("roll", roll_rad(up_body), tilt_max_rad)) return roll;
  return limit_reason("pitch", pitch_up_rad(up_body), tilt_max_rad);
}

namespace {

std::string percent(double share) { return decimal_text(100.0 * share, 2) + " %"; }
std::string ppm(double share) { return decimal_text(1e6 * share, 0) + " ppm"; }

}  // namespace

std::optional<std::string> air_reason(const GasReading& reading, const AirParams& params) {
  if (reading.methane_share >= params.methane_max_share) {
    return "methane " + percent(reading.methane_share) + ", limit " +
           percent(params.methane_max_share);
  }
  if (reading.oxygen_share < params.oxygen_min_share) {
    return "oxygen " + percent(reading.oxygen_share) + ", limit " +
           percent(params.oxygen_min_share);
  }
  if (reading.carbon_monoxide_share > params.carbon_monoxide_max_share) {
    return "carbon monoxide " + ppm(reading.carbon_monoxide_share) + ", limit " +
           ppm(params.carbon_monoxide_max_share);
  }
  return std::nullopt;
}

std::optional<std::string> sinkage_reason(const SinkageReading& reading, double depth_max_m) {
  constexpr std::array kWheels{"front left", "front right", "rear left", "rear right"};
  const auto deepest = std::ranges::max_element(reading.depth_m);
  if (!(*deepest > depth_max_m)) return std::nullopt;
  const auto wheel = static_cast<std::size_t>(deepest - reading.depth_m.begin());
  return std::string(kWheels[wheel]) + " wheel sunk in by " + decimal_text(*deepest, 2) +
         " m, limit " + decimal_text(depth_max_m, 2) + " m";
}

}  // namespace adit
