// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/tilt_reading.hpp"

#include "common/messages/checks.hpp"

namespace adit {

tilt_t to_message(const TiltReading& reading) {
  tilt_t message;
  message.utime = reading.utime;
  message.angle_rad = reading.angle_rad;
  message.rate_rad_s = reading.rate_rad_s;
  return message;
}

Result<TiltReading> from_message(const tilt_t& message) {
  if (!is_plausible_utime(message.utime)) return Refused{kImplausibleTime};
  if (!std::isfinite(message.angle_rad)) return Refused{"angle is not finite"};
  if (!std::isfinite(message.rate_rad_s)) return Refused{"rate is not finite"};
  return TiltReading{message.utime, message.angle_rad, message.rate_rad_s};
}

}  // namespace adit
