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
#include <vector>

#include "common/bus/forwarding_bus.hpp"

namespace adit {

/// Decorates the bus of a stage: measures the wall time of the stage for each message of some
/// channels, including decoding and publishing. The times do not affect messages, which must be
/// reproducible.
class StopwatchBus final : public ForwardingBus {
 public:
  struct Handled {
    double ms = 0.0;
    bool answered = false;  ///< the stage published a message in the handler
  };

  StopwatchBus(Bus& bus, std::set<std::string, std::less<>> channels)
      : ForwardingBus(bus), channels_(std::move(channels)) {}

  /// Messages of these channels, in order.
  [[nodiscard]] const std::vector<Handled>& handled() const { return handled_; }

  void publish(std::string_view channel, std::span<const std::uint8_t> bytes) override {
    answered_ = true;
    ForwardingBus::publish(channel, bytes);
  }
  SubscriptionId subscribe(std::string_view channel, Delivery delivery, Handler handler) override;

 private:
  std::set<std::string, std::less<>> channels_;
  std::vector<Handled> handled_;
  bool answered_ = false;
};

/// Times of all messages, or only of the answered ones [ms].
std::vector<double> milliseconds(const StopwatchBus& stopwatch, bool answered_only);

}  // namespace adit
