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

/// The subscriptions of a bus and their queues of messages, handled in order of arrival. Shared by
/// all implementations of Bus, so that a full queue drops the same messages in each.
class Dispatcher {
 public:
  static constexpr std::size_t kDefaultMaxMessageBytes = 4U << 20U;

  /// Rejects larger messages without decoding them.
  explicit Dispatcher(std::size_t max_message_bytes = kDefaultMaxMessageBytes)
      : max_message_bytes_(max_message_bytes) {}

  SubscriptionId subscribe(std::string_view channel, Delivery delivery, Handler handler);

  /// Appends a copy of the message to the queue of each subscription to its channel.
  void enqueue(const ReceivedMessage& received);

  /// Counts a message that is not queued as rejected by each subscription to its channel.
  void reject(std::string_view channel, std::string_view reason);

  /// Passes the oldest queued message to its handler. Returns false if all queues are empty.
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
