// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/bus/bus.hpp"

namespace adit {

/// The subscriptions of a bus and the messages that wait for their handlers, in order of arrival.
/// Shared by all forms of the bus, so that a queue drops the same messages in all of them.
class Dispatcher {
 public:
  static constexpr std::size_t kDefaultMaxMessageBytes = 4U << 20U;

  /// Larger messages are refused unread.
  explicit Dispatcher(std::size_t max_message_bytes = kDefaultMaxMessageBytes)
      : max_message_bytes_(max_message_bytes) {}

  SubscriptionId subscribe(std::string_view channel, Delivery delivery, Handler handler);

  /// Puts a copy of the message into the queue of each subscription to its channel.
  void enqueue(const ReceivedMessage& received);

  /// Hands the message that waits longest to its handler. False if none waits.
  bool dispatch_one();

  [[nodiscard]] bool is_idle() const { return oldest() == nullptr; }
  [[nodiscard]] const SubscriptionStats& stats(SubscriptionId id) const {
    return subscriptions_.at(id)->stats;
  }

 private:
  struct Message {
    std::uint64_t arrival;
    std::string channel;
    std::int64_t utime;
    std::vector<std::uint8_t> bytes;
  };
  struct Subscription {
    Delivery delivery;
    Handler handler;
    SubscriptionStats stats;
    std::deque<std::shared_ptr<const Message>> queue;
  };

  [[nodiscard]] Subscription* oldest() const;

  std::size_t max_message_bytes_;
  std::uint64_t arrivals_ = 0;
  std::vector<std::unique_ptr<Subscription>> subscriptions_;  // handlers may subscribe
};

}  // namespace adit
