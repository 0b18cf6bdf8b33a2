// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/bus/forwarding_bus.hpp"

namespace adit {

/// The bus of one stage: forwards to a shared bus and records the stage's subscriptions, so that
/// stages on one bus report their own statistics. Optionally measures handler times, for stages
/// that run on the wall clock.
///
/// An exception of a handler or timer ends here, as the last defence against what a message may
/// cause: the message counts as rejected, and `failures` says what failed. What the stage knows may
/// be half changed, so handlers check a message before they use it. A FileError or
/// std::system_error passes, since the stage cannot work without its files and devices, and a
/// NodeEnd.
class StageBus final : public ForwardingBus {
 public:
  static constexpr std::string_view kHandlerFailed = "the handler failed";

  struct Failures {
    std::int64_t count = 0;
    std::string last;  ///< channel, or "a timer", and what failed
  };

  struct HandlerTimes {
    std::int64_t calls = 0;
    double total_ms = 0.0;
    double max_ms = 0.0;
  };

  enum class Measure { kNothing, kHandlerTimes };

  /// `bus` must outlive this.
  StageBus(Bus& bus, Measure measure) : ForwardingBus(bus), measure_(measure) {}

  /// The subscriptions of the stage in the order of creation.
  [[nodiscard]] const std::vector<SubscriptionId>& subscriptions() const { return subscriptions_; }

  /// Handler times since the last call, one for each of `subscriptions()`; zero calls without
  /// measurement.
  std::vector<HandlerTimes> take_handler_times();

  /// Exceptions of handlers and timers since the start.
  [[nodiscard]] const Failures& failures() const { return failures_; }

  SubscriptionId subscribe(std::string_view channel, Delivery delivery, Handler handler) override;
  void create_timer(std::int64_t period_us, TimerHandler handler) override;
  void create_wall_timer(std::int64_t period_us, TimerHandler handler) override;
  void watch(int descriptor, std::function<void()> handler) override;

 private:
  Handler with_timing(Handler handler);
  Handler contained(std::string_view channel, Handler handler);
  TimerHandler contained(TimerHandler handler);
  /// Calls a function. Returns false if it throws.
  bool contain(std::string_view what, const std::function<void()>& function);

  Measure measure_;
  std::vector<SubscriptionId> subscriptions_;
  std::vector<HandlerTimes> times_;
  Failures failures_;
};

}  // namespace adit
