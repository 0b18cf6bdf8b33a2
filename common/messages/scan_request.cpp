// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/scan_request.hpp"

#include "common/messages/checks.hpp"
#include "common/messages/laser_channel.hpp"

namespace adit {

scan_request_t to_message(const ScanRequest& request) {
  scan_request_t message;
  message.utime = request.utime;
  message.id = request.id;
  message.laser = laser_channel(request.laser);
  return message;
}

Result<ScanRequest> from_message(const scan_request_t& message) {
  if (!is_plausible_utime(message.utime)) return Refused{kImplausibleTime};
  if (message.id < 0) return Refused{"negative id"};
  const auto laser = laser_of(message.laser);
  if (!laser) return Refused{kUnknownLaser};
  return ScanRequest{message.utime, message.id, *laser};
}

}  // namespace adit
