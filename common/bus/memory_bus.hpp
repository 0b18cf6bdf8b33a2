// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <utility>

#include "common/bus/bus.hpp"
#include "common/bus/dispatcher.hpp"
#include "common/bus/timers.hpp"

namespace adit {

/// A bus within one process, without threads and clocks: the caller advances bus time.
/// Deterministic: a message published in a handler is handled after all messages published before
/// it, and all messages have been handled when `inject`, `advance_to` or an outer `publish`
/// returns.
class MemoryBus : public Bus {
 public:
  /// Called with every message in the order of publication, with bus time.
  using Tap = std::function<void(const ReceivedMessage&)>;

  explicit MemoryBus(std::size_t max_message_bytes = Dispatcher::kDefaultMaxMessageBytes)
      : dispatcher_(max_message_bytes) {}

  /// Advances bus time to `utime`, runs the due timers, then publishes. Bus time is monotonic: an
  /// older message is published at the current bus time. Accepts any channel name, also one that
  /// `publish` rejects.
  void inject(std::int64_t utime, std::string_view channel, std::span<const std::uint8_t> bytes);

  /// Advances bus time to `utime` and runs the due timers.
  void advance_to(std::int64_t utime);

  void tap(Tap tap) { tap_ = std::move(tap); }

  void publish(std::string_view channel, std::span<const std::uint8_t> bytes) override;
  SubscriptionId subscribe(std::string_view channel, Delivery delivery, Handler handler) override;
  void create_timer(std::int64_t period_us, TimerHandler handler) override;
  /// 0 before the first inject or advance_to.
  [[nodiscard]] std::int64_t now_utime() const override { return now_utime_; }
  [[nodiscard]] const SubscriptionStats& stats(SubscriptionId id) const override;

 private:
  void deliver(const ReceivedMessage& received);
  void run(const std::function<void()>& work);

  Dispatcher dispatcher_;
  Timers timers_;
  Tap tap_;
  std::int64_t now_utime_ = 0;
  bool running_ = false;
};

}  // namespace adit
