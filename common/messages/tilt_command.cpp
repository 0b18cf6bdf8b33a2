// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/tilt_command.hpp"

#include "common/messages/checks.hpp"

namespace adit {

tilt_command_t to_message(const TiltCommand& command) {
  tilt_command_t message;
  message.utime = command.utime;
  message.goal_rad = command.angle_rad;
  message.rate_max_rad_s = command.rate_rad_s;
  return message;
}

Result<TiltCommand> from_message(const tilt_command_t& message) {
  if (!is_plausible_utime(message.utime)) return Refused{kImplausibleTime};
  if (!std::isfinite(message.goal_rad)) return Refused{"angle is not finite"};
  if (!std::isfinite(message.rate_max_rad_s)) return Refused{"rate is not finite"};
  if (message.rate_max_rad_s <= 0.0) return Refused{"rate is not positive"};
  return TiltCommand{message.utime, message.goal_rad, message.rate_max_rad_s};
}

}  // namespace adit
