// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "common/bus/forwarding_bus.hpp"
#include "tools/map/time_statistics.hpp"

namespace adit {

/// Decorates the bus of a stage: measures the wall time of the stage for each message of some
/// channels, including decoding and publishing. The times do not affect messages, which must be
/// reproducible.
class StopwatchBus final : public ForwardingBus {
 public:
  StopwatchBus(Bus& bus, std::set<std::string, std::less<>> channels)
      : ForwardingBus(bus), channels_(std::move(channels)) {}

  /// Of all messages of these channels.
  [[nodiscard]] const TimeStatistics& handled() const { return handled_; }
  /// Of those in whose handler the stage published a message.
  [[nodiscard]] const TimeStatistics& answered() const { return answered_times_; }

  void publish(std::string_view channel, std::span<const std::uint8_t> bytes) override {
    answered_ = true;
    ForwardingBus::publish(channel, bytes);
  }
  SubscriptionId subscribe(std::string_view channel, Delivery delivery, Handler handler) override;

 private:
  std::set<std::string, std::less<>> channels_;
  TimeStatistics handled_;
  TimeStatistics answered_times_;
  bool answered_ = false;
};

}  // namespace adit
