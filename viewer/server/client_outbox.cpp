// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/server/client_outbox.hpp"

#include <utility>

#include "viewer/server/protocol.hpp"

namespace adit {
namespace {

constexpr std::int64_t kNanosecondsPerMicrosecond = 1000;

ClientOutbox::Frame frame_of(std::uint32_t subscription, const TopicMessage& message) {
  return {
      false,
      foxglove_protocol::message_header(subscription, message.utime * kNanosecondsPerMicrosecond),
      message.bytes};
}

}  // namespace

void ClientOutbox::push_text(std::string text) {
  protocol_.push_back({true, std::move(text), nullptr});
}

void ClientOutbox::push_binary(std::string bytes) {
  protocol_.push_back({false, std::move(bytes), nullptr});
}

void ClientOutbox::push(std::uint32_t subscription, Retention retention,
                        const TopicMessage& message) {
  if (retention == Retention::kLatest) {
    latest_[subscription] = message;
  } else {
    appended_.push_back({subscription, message});
  }
}

void ClientOutbox::drop(std::uint32_t subscription) {
  latest_.erase(subscription);
  std::erase_if(appended_,
                [&](const Appended& waiting) { return waiting.subscription == subscription; });
}

std::optional<ClientOutbox::Frame> ClientOutbox::pop() {
  if (!protocol_.empty()) {
    Frame frame = std::move(protocol_.front());
    protocol_.pop_front();
    return frame;
  }
  if (time_ns_)
    return Frame{false, foxglove_protocol::time_message(*std::exchange(time_ns_, {})), {}};
  if (!appended_.empty()) {
    const Appended waiting = std::move(appended_.front());
    appended_.pop_front();
    return frame_of(waiting.subscription, waiting.message);
  }
  if (latest_.empty()) return std::nullopt;
  auto turn = latest_.lower_bound(next_);
  if (turn == latest_.end()) turn = latest_.begin();
  Frame frame = frame_of(turn->first, turn->second);
  next_ = turn->first + 1;
  latest_.erase(turn);
  return frame;
}

}  // namespace adit
