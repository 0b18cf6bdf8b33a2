// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/stopwatch_bus.hpp"

#include <chrono>

namespace adit {

SubscriptionId StopwatchBus::subscribe(std::string_view channel, Delivery delivery,
                                       Handler handler) {
  if (!channels_.contains(channel))
    return ForwardingBus::subscribe(channel, delivery, std::move(handler));
  return ForwardingBus::subscribe(
      channel, delivery, [this, handler = std::move(handler)](const ReceivedMessage& received) {
        const auto start = std::chrono::steady_clock::now();
        answered_ = false;
        const std::string_view rejection = handler(received);
        const std::chrono::duration<double, std::milli> taken =
            std::chrono::steady_clock::now() - start;
        handled_.add(taken.count());
        if (answered_) answered_times_.add(taken.count());
        return rejection;
      });
}

}  // namespace adit
