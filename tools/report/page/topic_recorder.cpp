// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/page/topic_recorder.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace adit {
namespace {

constexpr std::size_t kMessagesMin = 3;

}  // namespace

void TopicRecorder::begin(const LimitsOf& limits) {
  for (const Topic& topic : board_.topics()) topics_.push_back({limits(topic), 0, false, 0, {}});
}

void TopicRecorder::record(std::int64_t utime) {
  const auto wanted = [&](TopicId id) {
    const bool appended = board_.topics()[id].retention == Retention::kAppended;
    const Kept& kept = topics_.at(id);
    if (kept.limits.interval_us == kAtEnd) return appended;
    return appended || !kept.any || utime >= kept.last_utime + kept.limits.interval_us;
  };
  take(board_.take_due(utime, wanted), utime);
}

void TopicRecorder::finish(std::int64_t utime) { take(board_.take_changed(), utime); }

void TopicRecorder::take(std::vector<TopicBoard::Update> updates, std::int64_t utime) {
  for (TopicBoard::Update& update : updates) {
    Kept& kept = topics_.at(update.topic);
    kept.any = true;
    kept.last_utime = utime;
    kept.bytes += update.message.bytes->size();
    kept.messages.push_back(std::move(update.message));
    const bool thinned = board_.topics()[update.topic].retention == Retention::kLatest;
    while (thinned && kept.bytes > kept.limits.bytes_max && kept.messages.size() > kMessagesMin) {
      thin(kept);
    }
  }
}

void TopicRecorder::thin(Kept& kept) {
  std::deque<TopicMessage> rest;
  const std::size_t last = kept.messages.size() - 1;
  kept.bytes = 0;
  for (std::size_t i = 0; i <= last; ++i) {
    if (i % 2 != 0 && i != last) continue;
    kept.bytes += kept.messages[i].bytes->size();
    rest.push_back(std::move(kept.messages[i]));
  }
  kept.messages = std::move(rest);
  kept.limits.interval_us *= 2;
}

std::vector<TopicRecorder::Record> TopicRecorder::records() const {
  std::vector<Record> records;
  for (TopicId id = 0; id < topics_.size(); ++id) {
    for (const TopicMessage& message : topics_[id].messages) records.push_back({id, message});
  }
  std::stable_sort(records.begin(), records.end(), [](const Record& a, const Record& b) {
    return a.message.utime < b.message.utime;
  });
  return records;
}

}  // namespace adit
