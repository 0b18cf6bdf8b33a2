// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <string_view>
#include <utility>

#include "common/bus/bus.hpp"
#include "common/messages/codec.hpp"

namespace adit {

template <class Msg>
void publish(Bus& bus, std::string_view channel, const Msg& message) {
  bus.publish(channel, encode(message));
}

/// Subscribes with a handler of the message (`const planar_lidar_t&`) or of the value that
/// `from_message` returns for it (`const LaserScan&`). Messages that do not decode or convert are
/// rejected and counted, see Bus::stats.
template <class Msg, class TypedHandler>
SubscriptionId subscribe(Bus& bus, std::string_view channel, Delivery delivery,
                         TypedHandler handler) {
  return bus.subscribe(
      channel, delivery,
      [handler = std::move(handler)](const ReceivedMessage& received) mutable -> std::string_view {
        const Result<Msg> message = decode<Msg>(received.bytes);
        if (!message) return message.rejection();
        if constexpr (std::invocable<TypedHandler&, const Msg&>) {
          handler(*message);
        } else {
          const auto value = from_message(*message);
          if (!value) return value.rejection();
          handler(*value);
        }
        return {};
      });
}

}  // namespace adit
