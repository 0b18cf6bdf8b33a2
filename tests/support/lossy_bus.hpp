// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <string_view>

#include "common/bus/bus.hpp"

namespace adit::test {

/// Fault injection: a bus that loses a share of the messages to its subscribers at random, each
/// subscription independently, like datagrams on a bad network. Messages of the simulated clock
/// (SIM_TIME, SIM_TIME_DONE) are never lost: a real robot has none, and stages wait for them.
/// Forwards everything else to the decorated bus. The same seed loses the same messages.
class LossyBus final : public Bus {
 public:
  /// `bus` must outlive this. `share` is from 0 to 1.
  LossyBus(Bus& bus, double share, std::uint64_t seed) : bus_(bus), loss_(share), random_(seed) {}
  LossyBus(const LossyBus&) = delete;
  LossyBus& operator=(const LossyBus&) = delete;

  void publish(std::string_view channel, std::span<const std::uint8_t> bytes) override {
    bus_.publish(channel, bytes);
  }
  SubscriptionId subscribe(std::string_view channel, Delivery delivery, Handler handler) override;
  void create_timer(std::int64_t period_us, TimerHandler handler) override;
  void create_wall_timer(std::int64_t period_us, TimerHandler handler) override;
  [[nodiscard]] std::int64_t now_utime() const override { return bus_.now_utime(); }
  /// Lost messages count as handled.
  [[nodiscard]] const SubscriptionStats& stats(SubscriptionId id) const override {
    return bus_.stats(id);
  }
  [[nodiscard]] std::int64_t unsent() const override { return bus_.unsent(); }

  [[nodiscard]] std::int64_t lost() const { return lost_; }

 private:
  Bus& bus_;
  std::bernoulli_distribution loss_;
  std::mt19937_64 random_;
  std::int64_t lost_ = 0;
};

}  // namespace adit::test
