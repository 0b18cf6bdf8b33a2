// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/sinkage_reading.hpp"

#include <algorithm>

#include "common/messages/checks.hpp"

namespace adit {

sinkage_t to_message(const SinkageReading& reading) {
  sinkage_t message;
  message.utime = reading.utime;
  std::ranges::copy(reading.depth_m, message.depth_m);
  return message;
}

Result<SinkageReading> from_message(const sinkage_t& message) {
  if (!is_plausible_utime(message.utime)) return Refused{kImplausibleTime};
  if (!all_finite(message.depth_m)) return Refused{"depth is not finite"};
  if (std::ranges::min(message.depth_m) < 0.0) return Refused{"depth is negative"};
  SinkageReading reading{message.utime, {}};
  std::ranges::copy(message.depth_m, reading.depth_m.begin());
  return reading;
}

}  // namespace adit
