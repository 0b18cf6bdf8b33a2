// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "common/bus/bus.hpp"

namespace adit {

/// Passes a bus on to the stages of a run and keeps the wall time of every laser scan that they
/// handle, decoding and publishing included. The times go nowhere near the messages, which must
/// repeat byte for byte.
class StopwatchBus final : public Bus {
 public:
  explicit StopwatchBus(Bus& bus) : bus_(bus) {}

  /// Of each scan in order [ms].
  [[nodiscard]] const std::vector<double>& scan_ms() const { return scan_ms_; }

  void publish(std::string_view channel, std::span<const std::uint8_t> bytes) override {
    bus_.publish(channel, bytes);
  }
  SubscriptionId subscribe(std::string_view channel, Delivery delivery, Handler handler) override;
  void every(std::int64_t period_us, TimerHandler handler) override {
    bus_.every(period_us, std::move(handler));
  }
  [[nodiscard]] std::int64_t now_utime() const override { return bus_.now_utime(); }
  [[nodiscard]] const SubscriptionStats& stats(SubscriptionId id) const override {
    return bus_.stats(id);
  }

 private:
  Bus& bus_;
  std::vector<double> scan_ms_;
};

}  // namespace adit
