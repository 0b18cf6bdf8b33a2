// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "common/bus/bus.hpp"

namespace adit {

/// A bus as one stage sees it: passes everything on, and remembers which subscriptions are the
/// stage's own, so that stages that share a bus report apart. Where the stage runs by the wall
/// clock, it also measures how long handlers take.
class StageBus final : public Bus {
 public:
  struct HandlerTimes {
    std::int64_t calls = 0;
    double total_ms = 0.0;
    double max_ms = 0.0;
  };

  enum class Measure { kNothing, kHandlerTimes };

  StageBus(Bus& bus, Measure measure) : bus_(bus), measure_(measure) {}

  /// The subscriptions of the stage in the order in which they were made.
  [[nodiscard]] const std::vector<SubscriptionId>& subscriptions() const { return subscriptions_; }

  /// Since the last call, for each of `subscriptions()`; nothing measured is no calls.
  std::vector<HandlerTimes> take_handler_times();

  void publish(std::string_view channel, std::span<const std::uint8_t> bytes) override;
  SubscriptionId subscribe(std::string_view channel, Delivery delivery, Handler handler) override;
  void every(std::int64_t period_us, TimerHandler handler) override;
  void every_of_world(std::int64_t period_us, TimerHandler handler) override;
  [[nodiscard]] std::int64_t now_utime() const override { return bus_.now_utime(); }
  [[nodiscard]] const SubscriptionStats& stats(SubscriptionId id) const override;
  [[nodiscard]] std::int64_t unsent() const override { return bus_.unsent(); }

 private:
  Handler measured(Handler handler);

  Bus& bus_;
  Measure measure_;
  std::vector<SubscriptionId> subscriptions_;
  std::vector<HandlerTimes> times_;
};

}  // namespace adit
