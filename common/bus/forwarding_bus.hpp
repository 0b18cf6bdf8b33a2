// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <utility>

#include "common/bus/bus.hpp"

namespace adit {

/// A bus in front of another one, to which it forwards everything. A decorator overrides what it
/// changes.
class ForwardingBus : public Bus {
 public:
  /// `bus` must outlive this.
  explicit ForwardingBus(Bus& bus) : bus_(bus) {}
  ForwardingBus(const ForwardingBus&) = delete;
  ForwardingBus& operator=(const ForwardingBus&) = delete;

  void publish(std::string_view channel, std::span<const std::uint8_t> bytes) override {
    bus_.publish(channel, bytes);
  }
  SubscriptionId subscribe(std::string_view channel, Delivery delivery, Handler handler) override {
    return bus_.subscribe(channel, delivery, std::move(handler));
  }
  void create_timer(std::int64_t period_us, TimerHandler handler) override {
    bus_.create_timer(period_us, std::move(handler));
  }
  void create_wall_timer(std::int64_t period_us, TimerHandler handler) override {
    bus_.create_wall_timer(period_us, std::move(handler));
  }
  void watch(int descriptor, std::function<void()> handler) override {
    bus_.watch(descriptor, std::move(handler));
  }
  [[nodiscard]] std::int64_t now_utime() const override { return bus_.now_utime(); }
  [[nodiscard]] const SubscriptionStats& stats(SubscriptionId id) const override {
    return bus_.stats(id);
  }
  [[nodiscard]] std::int64_t unsent() const override { return bus_.unsent(); }
  [[nodiscard]] std::int64_t without_valid_seal() const override {
    return bus_.without_valid_seal();
  }

 private:
  Bus& bus_;
};

}  // namespace adit
