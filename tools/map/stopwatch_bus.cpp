// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/stopwatch_bus.hpp"

#include <chrono>
#include <utility>

#include "common/bus/channels.hpp"

namespace adit {

SubscriptionId StopwatchBus::subscribe(std::string_view channel, Delivery delivery,
                                       Handler handler) {
  if (channel != channels::kLaserFront && channel != channels::kLaserRear) {
    return bus_.subscribe(channel, delivery, std::move(handler));
  }
  return bus_.subscribe(channel, delivery,
                        [this, handler = std::move(handler)](const Received& received) {
                          const auto start = std::chrono::steady_clock::now();
                          const std::string_view refusal = handler(received);
                          const std::chrono::duration<double, std::milli> taken =
                              std::chrono::steady_clock::now() - start;
                          scan_ms_.push_back(taken.count());
                          return refusal;
                        });
}

}  // namespace adit
