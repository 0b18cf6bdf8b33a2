// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/limit_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "common/sensing/attitude_filter.hpp"

namespace adit {
namespace {

std::optional<std::string> limit_reason(const char* name, double angle_rad, double max_rad) {
  if (!(std::abs(angle_rad) > max_rad)) return std::nullopt;
  return fmt::format("{} of {:.2f} rad, limit {:.2f} rad", name, angle_rad, max_rad);
}

std::string percent(double share) { return fmt::format("{:.2f} %", 100.0 * share); }
std::string ppm(double share) { return fmt::format("{:.0f} ppm", 1e6 * share); }

}  // namespace

std::optional<std::string> tilt_reason(const Eigen::Vector3d& up_body, double tilt_max_rad) {
  if (auto roll = limit_reason("roll", roll_rad(up_body), tilt_max_rad)) return roll;
  return limit_reason("pitch", pitch_up_rad(up_body), tilt_max_rad);
}

std::optional<std::string> air_reason(const GasReading& reading, const AirParams& params) {
  if (reading.methane_share >= params.methane_max_share) {
    return fmt::format("methane {}, limit {}", percent(reading.methane_share),
                       percent(params.methane_max_share));
  }
  if (reading.oxygen_share < params.oxygen_min_share) {
    return fmt::format("oxygen {}, limit {}", percent(reading.oxygen_share),
                       percent(params.oxygen_min_share));
  }
  if (reading.carbon_monoxide_share > params.carbon_monoxide_max_share) {
    return fmt::format("carbon monoxide {}, limit {}", ppm(reading.carbon_monoxide_share),
                       ppm(params.carbon_monoxide_max_share));
  }
  return std::nullopt;
}

std::optional<std::string> sinkage_reason(const SinkageReading& reading, double depth_max_m) {
  constexpr std::array kWheels{"front left", "front right", "rear left", "rear right"};
  const auto deepest = std::ranges::max_element(reading.depth_m);
  if (!(*deepest > depth_max_m)) return std::nullopt;
  const auto wheel = static_cast<std::size_t>(deepest - reading.depth_m.begin());
  return fmt::format("{} wheel sunk in by {:.2f} m, limit {:.2f} m", kWheels[wheel], *deepest,
                     depth_max_m);
}

}  // namespace adit
