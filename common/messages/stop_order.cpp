// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/stop_order.hpp"

#include "common/messages/checks.hpp"

namespace adit {

stop_t to_message(const StopOrder& order) {
  stop_t message;
  message.utime = order.utime;
  message.stopped = static_cast<std::int8_t>(order.stopped);
  message.reason = order.reason;
  return message;
}

Result<StopOrder> from_message(const stop_t& message) {
  if (!is_plausible_utime(message.utime)) return Refused{kImplausibleTime};
  return StopOrder{message.utime, message.stopped != 0, message.reason};
}

}  // namespace adit
