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

Result<LaserScan> from_message(const planar_lidar_t& message) {
  constexpr double kTwoTurns = 4.0 * std::numbers::pi;
  if (!is_plausible_utime(message.utime)) return Refused{kImplausibleTime};
  if (!std::isfinite(message.rad0)) return Refused{"first bearing is not finite"};
  if (!(message.radstep > 0.0F)) return Refused{"bearings do not increase"};
  if (message.nranges * static_cast<double>(message.radstep) > kTwoTurns) {
    return Refused{"bearings go round more than twice"};
  }
  return LaserScan{message.utime, message.ranges, message.rad0, message.radstep};
}

}  // namespace adit
