// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/scan_request.hpp"

#include "common/messages/checks.hpp"

namespace adit {
namespace {

constexpr const char* kFront = "LASER_FRONT";
constexpr const char* kRear = "LASER_REAR";

}  // namespace

scan_request_t to_message(const ScanRequest& request) {
  scan_request_t message;
  message.utime = request.utime;
  message.id = request.id;
  message.laser = request.laser == LaserId::kFront ? kFront : kRear;
  return message;
}

Result<ScanRequest> from_message(const scan_request_t& message) {
  if (!is_plausible_utime(message.utime)) return Refused{kImplausibleTime};
  if (message.id < 0) return Refused{"negative id"};
  if (message.laser != kFront && message.laser != kRear) return Refused{"unknown laser"};
  const LaserId laser = message.laser == kFront ? LaserId::kFront : LaserId::kRear;
  return ScanRequest{message.utime, message.id, laser};
}

}  // namespace adit
