// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <vector>

#include "viewer/server/topic_board.hpp"

namespace adit {

/// Keeps the messages of the topics of a replayed mission, in bounded memory. Of a topic that sends
/// its newest message it keeps at most one in each interval; when these exceed the budget of the
/// topic it drops every second one and doubles the interval. So the messages are spread evenly over
/// a mission of any length. The first and the last are always kept.
class TopicRecorder {
 public:
  /// An interval: only the message at the end is kept.
  static constexpr std::int64_t kAtEnd = std::numeric_limits<std::int64_t>::max();

  struct Limits {
    std::int64_t interval_us = 0;  ///< shortest time between two messages [bus time, µs], or kAtEnd
    std::size_t bytes_max = 0;     ///< of all messages; of at least three
  };
  using LimitsOf = std::function<Limits(const Topic& topic)>;

  struct Record {
    TopicId topic = 0;
    TopicMessage message;
  };

  /// `board` must outlive this.
  explicit TopicRecorder(TopicBoard& board) : board_(board) {}

  /// Must be called when all topics have been added to the board.
  void begin(const LimitsOf& limits);
  /// Takes from the board what is due at a bus time.
  void record(std::int64_t utime);
  /// Takes the newest message of each topic, however recent the one before it.
  void finish(std::int64_t utime);

  /// In order of time; those of one time in order of topics.
  [[nodiscard]] std::vector<Record> records() const;

 private:
  struct Kept {
    Limits limits;
    std::int64_t last_utime = 0;
    bool any = false;
    std::size_t bytes = 0;
    std::deque<TopicMessage> messages;
  };

  void take(std::vector<TopicBoard::Update> updates, std::int64_t utime);
  static void thin(Kept& kept);

  TopicBoard& board_;
  std::vector<Kept> topics_;
};

}  // namespace adit
