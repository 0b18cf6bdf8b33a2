// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/stage_stats.hpp"

#include "common/messages/checks.hpp"

namespace adit {

stage_stats_t to_message(const StageStats& stats) {
  stage_stats_t message;
  message.utime = stats.utime;
  message.stage = stats.stage;
  message.interval_s = stats.interval_s;
  message.n_subscriptions = static_cast<std::int32_t>(stats.subscriptions.size());
  for (const StageStats::Subscription& subscription : stats.subscriptions) {
    message.channels.push_back(subscription.channel);
    message.handled.push_back(subscription.handled);
    message.refused.push_back(subscription.refused);
    message.dropped.push_back(subscription.dropped);
    message.handler_mean_ms.push_back(subscription.handler_mean_ms);
    message.handler_max_ms.push_back(subscription.handler_max_ms);
  }
  return message;
}

Result<StageStats> from_message(const stage_stats_t& message) {
  if (!is_plausible_utime(message.utime)) return Refused{kImplausibleTime};
  if (message.stage.empty()) return Refused{"no stage"};
  if (!(message.interval_s >= 0.0) || !std::isfinite(message.interval_s)) {
    return Refused{"interval is not a length of time"};
  }
  StageStats stats{message.utime, message.stage, message.interval_s, {}};
  for (std::size_t i = 0; i < message.channels.size(); ++i) {
    stats.subscriptions.push_back({message.channels[i], message.handled[i], message.refused[i],
                                   message.dropped[i], message.handler_mean_ms[i],
                                   message.handler_max_ms[i]});
  }
  return stats;
}

}  // namespace adit
