// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/lossy_bus.hpp"

#include <utility>

#include "common/bus/channels.hpp"

namespace adit::test {

SubscriptionId LossyBus::subscribe(std::string_view channel, Delivery delivery, Handler handler) {
  if (channel == channels::kSimTime || channel == channels::kSimTimeDone) {
    return bus_.subscribe(channel, delivery, std::move(handler));
  }
  return bus_.subscribe(
      channel, delivery,
      [this, handler = std::move(handler)](const ReceivedMessage& received) -> std::string_view {
        if (!loss_(random_)) return handler(received);
        ++lost_;
        return {};
      });
}

void LossyBus::create_timer(std::int64_t period_us, TimerHandler handler) {
  bus_.create_timer(period_us, std::move(handler));
}

void LossyBus::create_wall_timer(std::int64_t period_us, TimerHandler handler) {
  bus_.create_wall_timer(period_us, std::move(handler));
}

}  // namespace adit::test
