// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/node_host.hpp"

#include "common/bus/channels.hpp"
#include "common/bus/typed.hpp"
#include "common/messages/config_copy.hpp"
#include "common/messages/stage_stats.hpp"

namespace adit {
namespace {

constexpr std::int64_t kSecond = 1'000'000;

StageStats::Subscription difference(const SubscriptionStats& now, const SubscriptionStats& before) {
  return {now.channel, now.handled - before.handled, now.refused - before.refused,
          now.dropped - before.dropped};
}

void set_times(const StageBus::HandlerTimes& times, StageStats::Subscription& subscription) {
  const auto calls = static_cast<double>(times.calls);
  subscription.handler_mean_ms = times.calls > 0 ? times.total_ms / calls : 0.0;
  subscription.handler_max_ms = times.max_ms;
}

}  // namespace

NodeHost::NodeHost(Bus& bus, Stage stage, StageBus::Measure measure, std::ostream* complaints)
    : bus_(bus, measure),
      stage_(std::move(stage)),
      measure_(measure),
      complaints_(complaints),
      health_([] { return Health{}; }) {
  bus_.every(10 * kSecond, [this](std::int64_t utime) { publish_config(utime); });
  bus_.every(kSecond, [this](std::int64_t utime) { publish_heartbeat(utime); });
  bus_.every(5 * kSecond, [this](std::int64_t utime) { publish_stats(utime); });
}

void NodeHost::publish_config(std::int64_t utime) {
  const ConfigCopy copy{utime, stage_.name, stage_.version, stage_.yaml};
  publish(bus_, channels::kConfig, to_message(copy));
}

void NodeHost::publish_heartbeat(std::int64_t utime) {
  Heartbeat heartbeat{utime, stage_.name, health_(), 0, 0, 0};
  for (const SubscriptionId id : bus_.subscriptions()) {
    const SubscriptionStats& stats = bus_.stats(id);
    heartbeat.handled += stats.handled;
    heartbeat.refused += stats.refused;
    heartbeat.dropped += stats.dropped;
  }
  if (heartbeat.health.level == Health::Level::kOk && bus_.unsent() > 0) {
    heartbeat.health = {Health::Level::kDegraded,
                        std::to_string(bus_.unsent()) + " messages could not be sent"};
  }
  publish(bus_, channels::kHeartbeat, to_message(heartbeat));
  complain();
}

/// The first tick is at the start, with nothing done yet: it only sets what later ones count from.
void NodeHost::publish_stats(std::int64_t utime) {
  const auto start = std::exchange(last_stats_utime_, utime);
  StageStats stats{
      utime, stage_.name, static_cast<double>(utime - start.value_or(utime)) * 1e-6, {}};
  const std::vector<StageBus::HandlerTimes> times = bus_.take_handler_times();
  last_stats_.resize(times.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    const SubscriptionStats& now = bus_.stats(bus_.subscriptions()[i]);
    stats.subscriptions.push_back(difference(now, last_stats_[i]));
    if (measure_ == StageBus::Measure::kHandlerTimes) set_times(times[i], stats.subscriptions[i]);
    last_stats_[i] = now;
  }
  if (start) publish(bus_, channels::kStageStats, to_message(stats));
}

void NodeHost::complain() {
  if (!complaints_) return;
  for (const SubscriptionId id : bus_.subscriptions()) {
    for (const auto& [reason, count] : bus_.stats(id).refusals) {
      const std::string what = bus_.stats(id).channel + " refused: " + reason;
      if (told_.insert(what).second) *complaints_ << stage_.name << ": " << what << std::endl;
    }
  }
}

}  // namespace adit
