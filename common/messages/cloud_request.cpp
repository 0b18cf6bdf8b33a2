// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/cloud_request.hpp"

#include <algorithm>

#include "common/messages/checks.hpp"

namespace adit {

cloud_request_t to_message(const CloudRequest& request) {
  cloud_request_t message;
  message.utime = request.utime;
  message.asked_by = request.asked_by;
  message.after_utime = request.after_utime;
  message.n_have = static_cast<std::int32_t>(request.have_utime.size());
  message.have_utime = request.have_utime;
  return message;
}

Result<CloudRequest> from_message(const cloud_request_t& message) {
  if (!is_plausible_utime(message.utime) || !is_plausible_utime(message.after_utime) ||
      !std::ranges::all_of(message.have_utime, is_plausible_utime)) {
    return Refused{kImplausibleTime};
  }
  if (message.asked_by.empty()) return Refused{"no stage is named"};
  if (message.have_utime.size() > CloudRequest::kHaveMax)
    return Refused{"more scans than plausible"};
  return CloudRequest{message.utime, message.asked_by, message.after_utime, message.have_utime};
}

}  // namespace adit
