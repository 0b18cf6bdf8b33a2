// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/diagnostics.hpp"

#include "common/messages/fields/diagnostics_fields.hpp"

namespace adit {

heartbeat_t to_message(const Heartbeat& heartbeat) {
  heartbeat_t message;
  message.utime = heartbeat.utime;
  message.stage = heartbeat.stage;
  message.health = static_cast<std::int8_t>(heartbeat.health.level);
  message.reason = heartbeat.health.reason;
  message.handled = heartbeat.handled;
  message.rejected = heartbeat.rejected;
  message.dropped = heartbeat.dropped;
  return message;
}

Result<Heartbeat> from_message(const heartbeat_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  const Health health{Health::Level(message.health), message.reason};
  return Heartbeat{message.utime,   message.stage,    health,
                   message.handled, message.rejected, message.dropped};
}

config_t to_message(const ConfigSnapshot& snapshot) {
  config_t message;
  message.utime = snapshot.utime;
  message.stage = snapshot.stage;
  message.version = snapshot.version;
  message.yaml = snapshot.yaml;
  return message;
}

Result<ConfigSnapshot> from_message(const config_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  return ConfigSnapshot{message.utime, message.stage, message.version, message.yaml};
}

stage_stats_t to_message(const StageStats& stats) {
  stage_stats_t message;
  message.utime = stats.utime;
  message.stage = stats.stage;
  message.interval_s = stats.interval_s;
  message.n_subscriptions = static_cast<std::int32_t>(stats.subscriptions.size());
  for (const StageStats::Subscription& subscription : stats.subscriptions) {
    message.channels.push_back(subscription.channel);
    message.handled.push_back(subscription.handled);
    message.rejected.push_back(subscription.rejected);
    message.dropped.push_back(subscription.dropped);
    message.handler_mean_ms.push_back(subscription.handler_mean_ms);
    message.handler_max_ms.push_back(subscription.handler_max_ms);
  }
  return message;
}

Result<StageStats> from_message(const stage_stats_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  StageStats stats{message.utime, message.stage, message.interval_s, {}};
  for (std::size_t i = 0; i < message.channels.size(); ++i) {
    stats.subscriptions.push_back({message.channels[i], message.handled[i], message.rejected[i],
                                   message.dropped[i], message.handler_mean_ms[i],
                                   message.handler_max_ms[i]});
  }
  return stats;
}

}  // namespace adit
