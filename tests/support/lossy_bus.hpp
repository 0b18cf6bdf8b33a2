// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>
#include <string_view>

#include "common/bus/forwarding_bus.hpp"

namespace adit::test {

/// Fault injection: a bus that loses a share of the messages to its subscribers at random, each
/// subscription independently, like datagrams on a bad network. Messages of the simulated clock
/// (SIM_TIME, SIM_TIME_DONE) are never lost: a real robot has none, and stages wait for them.
/// Forwards everything else to the decorated bus. The same seed loses the same messages.
class LossyBus final : public ForwardingBus {
 public:
  /// `bus` must outlive this. `share` is from 0 to 1.
  LossyBus(Bus& bus, double share, std::uint64_t seed)
      : ForwardingBus(bus), loss_(share), random_(seed) {}

  /// Lost messages count as handled in `stats`.
  SubscriptionId subscribe(std::string_view channel, Delivery delivery, Handler handler) override;

  [[nodiscard]] std::int64_t lost() const { return lost_; }

 private:
  std::bernoulli_distribution loss_;
  std::mt19937_64 random_;
  std::int64_t lost_ = 0;
};

}  // namespace adit::test
