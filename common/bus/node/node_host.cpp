// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/node/node_host.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/node/version.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/diagnostics.hpp"

namespace adit {
namespace {

constexpr std::int64_t kSecond = 1'000'000;
constexpr std::int64_t kReportPeriod = 60 * kSecond;

std::string seals_text(std::int64_t count) {
  return std::to_string(count) + " orders without a valid seal were rejected";
}

std::string failures_text(const StageBus::Failures& failures) {
  return fmt::format("{} messages or timers failed, the last: {}", failures.count, failures.last);
}

StageStats::Subscription difference(const SubscriptionStats& now, const SubscriptionStats& before) {
  return {now.channel, now.handled - before.handled, now.rejected - before.rejected,
          now.dropped - before.dropped};
}

/// The reason of most rejections since then.
std::string main_reason(const SubscriptionStats& now, const SubscriptionStats& before) {
  std::string main;
  std::int64_t most = 0;
  for (const auto& [reason, count] : now.rejections) {
    const auto earlier = before.rejections.find(reason);
    const std::int64_t added = count - (earlier == before.rejections.end() ? 0 : earlier->second);
    if (added <= most) continue;
    most = added;
    main = reason;
  }
  return main;
}

void set_times(const StageBus::HandlerTimes& times, StageStats::Subscription& subscription) {
  const auto calls = static_cast<double>(times.calls);
  subscription.handler_mean_ms = times.calls > 0 ? times.total_ms / calls : 0.0;
  subscription.handler_max_ms = times.max_ms;
}

}  // namespace

NodeHost::NodeHost(Bus& bus, Stage stage, StageBus::Measure measure, std::ostream* error_stream)
    : bus_(bus, measure),
      stage_(std::move(stage)),
      measure_(measure),
      error_stream_(error_stream),
      health_([] { return Health{}; }) {
  bus_.create_timer(10 * kSecond, [this](std::int64_t utime) { publish_config(utime); });
  bus_.create_timer(kSecond, [this](std::int64_t utime) { publish_heartbeat(utime); });
  bus_.create_timer(5 * kSecond, [this](std::int64_t utime) { publish_stats(utime); });
}

void NodeHost::publish_config(std::int64_t utime) {
  const ConfigSnapshot copy{utime, stage_.name, stage_.version, stage_.yaml};
  publish(bus_, channels::kConfig, to_message(copy));
}

void NodeHost::publish_heartbeat(std::int64_t utime) {
  Heartbeat heartbeat{utime, stage_.name, health_(), 0, 0, 0};
  for (const SubscriptionId id : bus_.subscriptions()) {
    const SubscriptionStats& stats = bus_.stats(id);
    heartbeat.handled += stats.handled;
    heartbeat.rejected += stats.rejected;
    heartbeat.dropped += stats.dropped;
  }
  const StageBus::Failures& failures = bus_.failures();
  if (heartbeat.health.level == Health::Level::kOk && failures.count > 0) {
    heartbeat.health = {Health::Level::kDegraded, failures_text(failures)};
  }
  const Health inputs = input_health();
  if (heartbeat.health.level == Health::Level::kOk) heartbeat.health = inputs;
  if (heartbeat.health.level == Health::Level::kOk && bus_.unsent() > 0) {
    heartbeat.health = {Health::Level::kDegraded,
                        std::to_string(bus_.unsent()) + " messages were not sent"};
  }
  if (heartbeat.health.level == Health::Level::kOk && bus_.without_valid_seal() > 0) {
    heartbeat.health = {Health::Level::kDegraded, seals_text(bus_.without_valid_seal())};
  }
  publish(bus_, channels::kHeartbeat, to_message(heartbeat));
  report_rejections();
  report_in_turn(utime, failures.count, failures_text(failures), reported_failures_);
  report_in_turn(utime, bus_.without_valid_seal(), seals_text(bus_.without_valid_seal()),
                 reported_seals_);
}

/// Degraded if since the last heartbeat most messages of a channel were rejected.
Health NodeHost::input_health() {
  constexpr std::int64_t kRejectedMin = 5;
  Health health;
  heartbeat_stats_.resize(bus_.subscriptions().size());
  for (std::size_t i = 0; i < heartbeat_stats_.size(); ++i) {
    const SubscriptionStats& now = bus_.stats(bus_.subscriptions()[i]);
    const SubscriptionStats before = std::exchange(heartbeat_stats_[i], now);
    const std::int64_t rejected = now.rejected - before.rejected;
    const std::int64_t handled = now.handled - before.handled;
    if (rejected < kRejectedMin || rejected <= handled) continue;
    health = {Health::Level::kDegraded, std::to_string(rejected) + " of " +
                                            std::to_string(rejected + handled) + " messages on " +
                                            now.channel + " rejected: " + main_reason(now, before)};
  }
  return health;
}

std::vector<SubscriptionStats> NodeHost::subscription_stats() const {
  std::vector<SubscriptionStats> stats;
  for (const SubscriptionId id : bus_.subscriptions()) stats.push_back(bus_.stats(id));
  return stats;
}

/// The first tick comes at the start, before any message: it only sets the reference for the next.
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

void NodeHost::report_rejections() {
  if (!error_stream_) return;
  for (const SubscriptionId id : bus_.subscriptions()) {
    for (const auto& [reason, count] : bus_.stats(id).rejections) {
      const std::string what = bus_.stats(id).channel + " rejected: " + reason;
      if (reported_.insert(what).second) *error_stream_ << stage_.name << ": " << what << std::endl;
    }
  }
}

/// One line a minute at most: a neighbour who floods the network must not fill the disk.
void NodeHost::report_in_turn(std::int64_t utime, std::int64_t count, const std::string& text,
                              Report& last) const {
  if (!error_stream_ || count == last.count) return;
  if (last.utime && utime - *last.utime < kReportPeriod) return;
  last = {count, utime};
  *error_stream_ << stage_.name << ": " << text << std::endl;
}

HostedNode::HostedNode(Bus& bus, const ConfiguredNode& node, StageBus::Measure measure,
                       std::ostream* error_stream)
    : host_(bus, {node.stage, version(), node.yaml}, measure, error_stream),
      node_(node.construct(host_.bus())) {
  host_.set_health([this] { return node_->health(); });
}

}  // namespace adit
