// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/dispatcher.hpp"

#include <utility>

namespace adit {
namespace {

void count_rejection(std::string_view reason, SubscriptionStats& stats) {
  ++stats.rejected;
  ++stats.rejections[std::string(reason)];
}

}  // namespace

SubscriptionId Dispatcher::subscribe(std::string_view channel, Delivery delivery, Handler handler) {
  require_valid_channel(channel);
  auto subscription = std::make_unique<Subscription>();
  subscription->delivery = delivery;
  subscription->handler = std::move(handler);
  subscription->stats.channel = channel;
  subscriptions_.push_back(std::move(subscription));
  return subscriptions_.size() - 1;
}

void Dispatcher::enqueue(const ReceivedMessage& received) {
  std::shared_ptr<const Message> message;
  for (const auto& subscription : subscriptions_) {
    if (subscription->stats.channel != received.channel) continue;
    if (received.bytes.size() > max_message_bytes_) {
      count_rejection("too large", subscription->stats);
      continue;
    }
    if (!message) {
      message =
          std::make_shared<const Message>(Message{arrivals_++,
                                                  std::string(received.channel),
                                                  received.utime,
                                                  {received.bytes.begin(), received.bytes.end()}});
    }
    subscription->queue.push_back(message);
    if (subscription->queue.size() > subscription->delivery.capacity) {
      subscription->queue.pop_front();
      subscription->stats.dropped += subscription->delivery.counts_drops ? 1 : 0;
    }
  }
}

void Dispatcher::reject(std::string_view channel, std::string_view reason) {
  for (const auto& subscription : subscriptions_) {
    if (subscription->stats.channel == channel) count_rejection(reason, subscription->stats);
  }
}

Dispatcher::Subscription* Dispatcher::oldest() const {
  Subscription* oldest = nullptr;
  for (const auto& subscription : subscriptions_) {
    if (subscription->queue.empty()) continue;
    if (!oldest || subscription->queue.front()->arrival < oldest->queue.front()->arrival) {
      oldest = subscription.get();
    }
  }
  return oldest;
}

bool Dispatcher::dispatch_one() {
  Subscription* const subscription = oldest();
  if (!subscription) return false;
  const std::shared_ptr<const Message> message = subscription->queue.front();
  subscription->queue.pop_front();
  const std::string_view rejection =
      subscription->handler({message->channel, message->utime, message->bytes});
  if (rejection.empty()) {
    ++subscription->stats.handled;
  } else {
    count_rejection(rejection, subscription->stats);
  }
  return true;
}

}  // namespace adit
