// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/map_request.hpp"

#include "common/messages/checks.hpp"

namespace adit {

map_request_t to_message(const MapRequest& request) {
  map_request_t message;
  message.utime = request.utime;
  message.asked_by = request.asked_by;
  return message;
}

Result<MapRequest> from_message(const map_request_t& message) {
  if (!is_plausible_utime(message.utime)) return Refused{kImplausibleTime};
  if (message.asked_by.empty()) return Refused{"no stage is named"};
  return MapRequest{message.utime, message.asked_by};
}

}  // namespace adit
