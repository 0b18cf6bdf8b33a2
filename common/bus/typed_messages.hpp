// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <utility>

#include "common/bus/bus.hpp"
#include "common/bus/motion_steps.hpp"
#include "common/messages/codec.hpp"

namespace adit {

template <class Msg>
void publish(Bus& bus, std::string_view channel, const Msg& message) {
  bus.publish(channel, encode(message));
}

/// What a subscription checks of a value beside those before it: of a pose, whether a vehicle can
/// have made the step.
template <class Value>
class StreamCheck {
 public:
  std::string_view check(const Value& value, std::int64_t arrival_utime) {
    if constexpr (requires { stream_pose(value); }) {
      return steps_.check(stream_pose(value), arrival_utime);
    }
    return {};
  }

 private:
  struct Nothing {};
  static constexpr bool kIsPose = requires(const Value& value) { stream_pose(value); };
  std::conditional_t<kIsPose, MotionSteps, Nothing> steps_;
};

/// As `subscribe`, with a check of the value and bus time at its arrival, which returns the reason
/// for rejection or an empty text.
template <class Msg, class Check, class TypedHandler>
SubscriptionId subscribe_checked(Bus& bus, std::string_view channel, Delivery delivery, Check check,
                                 TypedHandler handler) {
  using Value = std::remove_cvref_t<decltype(*from_message(std::declval<const Msg&>()))>;
  return bus.subscribe(
      channel, delivery,
      [check = std::move(check), stream = StreamCheck<Value>(),
       handler = std::move(handler)](const ReceivedMessage& received) mutable -> std::string_view {
        const Result<Msg> message = decode<Msg>(received.bytes);
        if (!message) return message.rejection();
        const auto value = from_message(*message);
        if (!value) return value.rejection();
        std::string_view rejection = check(*value, received.utime);
        if (rejection.empty()) rejection = stream.check(*value, received.utime);
        if (rejection.empty()) handler(*value);
        return rejection;
      });
}

/// Subscribes with a handler of the message (`const planar_lidar_t&`) or of the value that
/// `from_message` returns for it (`const LaserScan&`). Messages that do not decode or convert are
/// rejected and counted, see Bus::stats; so are poses after a step that no vehicle makes.
template <class Msg, class TypedHandler>
SubscriptionId subscribe(Bus& bus, std::string_view channel, Delivery delivery,
                         TypedHandler handler) {
  if constexpr (std::invocable<TypedHandler&, const Msg&>) {
    return bus.subscribe(channel, delivery,
                         [handler = std::move(handler)](
                             const ReceivedMessage& received) mutable -> std::string_view {
                           const Result<Msg> message = decode<Msg>(received.bytes);
                           if (message) handler(*message);
                           return message.rejection();
                         });
  } else {
    return subscribe_checked<Msg>(
        bus, channel, delivery, [](const auto&, std::int64_t) { return std::string_view{}; },
        std::move(handler));
  }
}

}  // namespace adit
