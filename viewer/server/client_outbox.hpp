// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>

#include "viewer/server/topic_board.hpp"

namespace adit {

/// What waits to be sent to one client. The newest message of each topic of kLatest replaces an
/// older one that still waits, so that a slow client gets less, but nothing stale, and memory is
/// bounded.
class ClientOutbox {
 public:
  /// Messages of kAppended and of the protocol itself that may wait.
  static constexpr std::size_t kWaitingMax = 10'000;

  /// One message of the WebSocket: the head, then the payload if any.
  struct Frame {
    bool is_text = false;
    std::string head;
    std::shared_ptr<const std::string> payload;
  };

  /// Bus time; replaces one that waits.
  void push_time(std::int64_t time_ns) { time_ns_ = time_ns; }
  /// A message of the protocol itself.
  void push_text(std::string text);
  void push_binary(std::string bytes);
  /// A message of a topic for a subscription.
  void push(std::uint32_t subscription, Retention retention, const TopicMessage& message);
  /// Drops what waits for a subscription.
  void drop(std::uint32_t subscription);

  /// The next message to send: those of the protocol first, then appended ones in order, then the
  /// subscriptions of kLatest in turn.
  std::optional<Frame> pop();

  /// Whether the client has fallen so far behind that messages would be lost.
  [[nodiscard]] bool overflows() const {
    return protocol_.size() > kWaitingMax || appended_.size() > kWaitingMax;
  }

 private:
  struct Appended {
    std::uint32_t subscription = 0;
    TopicMessage message;
  };

  std::deque<Frame> protocol_;
  std::optional<std::int64_t> time_ns_;
  std::deque<Appended> appended_;
  std::map<std::uint32_t, TopicMessage> latest_;  ///< by subscription
  std::uint32_t next_ = 0;                        ///< subscription whose turn it is
};

}  // namespace adit
