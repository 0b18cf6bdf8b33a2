// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/memory_bus.hpp"

#include <algorithm>
#include <utility>

namespace adit {
namespace {

/// Sets a flag for its own lifetime.
class FlagGuard {
 public:
  explicit FlagGuard(bool& flag) : flag_(flag) { flag_ = true; }
  ~FlagGuard() { flag_ = false; }
  FlagGuard(const FlagGuard&) = delete;
  FlagGuard& operator=(const FlagGuard&) = delete;

 private:
  bool& flag_;
};

}  // namespace

void MemoryBus::run(const std::function<void()>& work) {
  if (running_) return work();
  const FlagGuard scope(running_);
  work();
  while (dispatcher_.dispatch_one()) {
  }
}

void MemoryBus::inject(std::int64_t utime, std::string_view channel,
                       std::span<const std::uint8_t> bytes) {
  advance_to(utime);
  deliver({channel, now_utime_, bytes});
}

void MemoryBus::advance_to(std::int64_t utime) {
  const std::int64_t target = std::max(utime, now_utime_);
  while (const auto tick = timers_.next(target)) {
    now_utime_ = std::max(now_utime_, tick->due_utime);
    run([&] { tick->handler(now_utime_); });
  }
  now_utime_ = target;
}

void MemoryBus::publish(std::string_view channel, std::span<const std::uint8_t> bytes) {
  require_valid_channel(channel);
  deliver({channel, now_utime_, bytes});
}

void MemoryBus::deliver(const ReceivedMessage& received) {
  if (tap_) tap_(received);
  run([&] { dispatcher_.enqueue(received); });
}

SubscriptionId MemoryBus::subscribe(std::string_view channel, Delivery delivery, Handler handler) {
  return dispatcher_.subscribe(channel, delivery, std::move(handler));
}

void MemoryBus::create_timer(std::int64_t period_us, TimerHandler handler) {
  timers_.add(period_us, std::move(handler));
}

const SubscriptionStats& MemoryBus::stats(SubscriptionId id) const { return dispatcher_.stats(id); }

}  // namespace adit
