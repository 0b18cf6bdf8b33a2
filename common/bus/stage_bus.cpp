// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/stage_bus.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace adit {

std::vector<StageBus::HandlerTimes> StageBus::take_handler_times() {
  return std::exchange(times_, std::vector<HandlerTimes>(subscriptions_.size()));
}

void StageBus::publish(std::string_view channel, std::span<const std::uint8_t> bytes) {
  bus_.publish(channel, bytes);
}

SubscriptionId StageBus::subscribe(std::string_view channel, Delivery delivery, Handler handler) {
  if (measure_ == Measure::kHandlerTimes) handler = measured(std::move(handler));
  times_.emplace_back();
  subscriptions_.push_back(bus_.subscribe(channel, delivery, std::move(handler)));
  return subscriptions_.back();
}

Handler StageBus::measured(Handler handler) {
  const std::size_t index = subscriptions_.size();
  return [this, index, handler = std::move(handler)](const Received& received) {
    const auto start = std::chrono::steady_clock::now();
    const std::string_view refusal = handler(received);
    const std::chrono::duration<double, std::milli> taken =
        std::chrono::steady_clock::now() - start;
    HandlerTimes& times = times_[index];
    ++times.calls;
    times.total_ms += taken.count();
    times.max_ms = std::max(times.max_ms, taken.count());
    return refusal;
  };
}

void StageBus::every_of_world(std::int64_t period_us, TimerHandler handler) {
  bus_.every_of_world(period_us, std::move(handler));
}

void StageBus::every(std::int64_t period_us, TimerHandler handler) {
  bus_.every(period_us, std::move(handler));
}

const SubscriptionStats& StageBus::stats(SubscriptionId id) const { return bus_.stats(id); }

}  // namespace adit
