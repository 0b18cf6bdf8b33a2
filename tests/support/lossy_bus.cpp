// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/lossy_bus.hpp"

#include <utility>

#include "common/bus/channels.hpp"

namespace adit::test {

SubscriptionId LossyBus::subscribe(std::string_view channel, Delivery delivery, Handler handler) {
  if (channel == channels::kSimTime || channel == channels::kSimTimeDone) {
    return ForwardingBus::subscribe(channel, delivery, std::move(handler));
  }
  return ForwardingBus::subscribe(
      channel, delivery,
      [this, handler = std::move(handler)](const ReceivedMessage& received) -> std::string_view {
        if (!loss_(random_)) return handler(received);
        ++lost_;
        return {};
      });
}

}  // namespace adit::test
