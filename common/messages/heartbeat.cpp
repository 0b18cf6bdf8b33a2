// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/heartbeat.hpp"

#include "common/messages/checks.hpp"

namespace adit {

heartbeat_t to_message(const Heartbeat& heartbeat) {
  heartbeat_t message;
  message.utime = heartbeat.utime;
  message.stage = heartbeat.stage;
  message.health = static_cast<std::int8_t>(heartbeat.health.level);
  message.reason = heartbeat.health.reason;
  message.handled = heartbeat.handled;
  message.refused = heartbeat.refused;
  message.dropped = heartbeat.dropped;
  return message;
}

Result<Heartbeat> from_message(const heartbeat_t& message) {
  const auto level = Health::Level(message.health);
  if (!is_plausible_utime(message.utime)) return Refused{kImplausibleTime};
  if (message.stage.empty()) return Refused{"no stage"};
  if (level < Health::Level::kOk || level > Health::Level::kFault) return Refused{"unknown health"};
  return Heartbeat{message.utime,   message.stage,   {level, message.reason},
                   message.handled, message.refused, message.dropped};
}

}  // namespace adit
