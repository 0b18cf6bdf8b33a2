// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/laser_scan.hpp"

#include <numbers>

#include "common/messages/checks.hpp"

namespace adit {

planar_lidar_t to_message(const LaserScan& scan) {
  planar_lidar_t message;
  message.utime = scan.utime;
  message.nranges = static_cast<std::int32_t>(scan.ranges_m.size());
  message.ranges = scan.ranges_m;
  message.nintensities = 0;
  message.rad0 = static_cast<float>(scan.angle_min_rad);
  message.radstep = static_cast<float>(scan.angle_step_rad);
  return message;
}

std::string_view reason_to_refuse(const LaserScan& scan) {
  constexpr double kTwoTurns = 4.0 * std::numbers::pi;
  if (!is_plausible_utime(scan.utime)) return kImplausibleTime;
  if (!std::isfinite(scan.angle_min_rad)) return "first bearing is not finite";
  if (!(scan.angle_step_rad > 0.0)) return "bearings do not increase";
  if (static_cast<double>(scan.ranges_m.size()) * scan.angle_step_rad > kTwoTurns) {
    return "bearings go round more than twice";
  }
  return {};
}

Result<LaserScan> from_message(const planar_lidar_t& message) {
  LaserScan scan{message.utime, message.ranges, message.rad0, message.radstep};
  if (const auto reason = reason_to_refuse(scan); !reason.empty()) return Refused{reason};
  return scan;
}

}  // namespace adit
