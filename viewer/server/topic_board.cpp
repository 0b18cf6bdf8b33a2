// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/server/topic_board.hpp"

#include <algorithm>
#include <utility>

namespace adit {

TopicId TopicBoard::add(Topic topic, Encode encode) {
  topic.retention = Retention::kLatest;
  topics_.push_back(std::move(topic));
  contents_.emplace_back().encode = std::move(encode);
  return static_cast<TopicId>(topics_.size() - 1);
}

TopicId TopicBoard::add(Topic topic) {
  topic.retention = Retention::kAppended;
  topics_.push_back(std::move(topic));
  contents_.emplace_back();
  return static_cast<TopicId>(topics_.size() - 1);
}

void TopicBoard::set_changed(TopicId topic, std::int64_t utime) {
  Content& content = contents_.at(topic);
  content.utime = utime;
  content.changed = true;
}

void TopicBoard::append(TopicId topic, std::int64_t utime, std::string bytes,
                        const std::string& key) {
  const TopicMessage message{utime, std::make_shared<const std::string>(std::move(bytes))};
  auto& kept = contents_.at(topic).kept;
  const auto earlier =
      key.empty() ? kept.end() : std::find_if(kept.begin(), kept.end(), [&](const Kept& other) {
        return other.key == key;
      });
  if (earlier != kept.end()) {
    earlier->message = message;
  } else {
    kept.push_back({key, message});
    if (kept.size() > kAppendedMax) kept.pop_front();
  }
  appended_.push_back({topic, message});
}

bool TopicBoard::encode(Content& content) {
  std::string bytes = content.encode();
  content.changed = false;
  if (bytes.empty()) return false;
  content.newest = {content.utime, std::make_shared<const std::string>(std::move(bytes))};
  return true;
}

std::vector<TopicBoard::Update> TopicBoard::take(const std::function<bool(TopicId)>& wanted,
                                                 const std::function<bool(TopicId)>& is_due) {
  std::vector<Update> updates;
  std::swap(updates, appended_);
  std::erase_if(updates, [&](const Update& update) { return !wanted(update.topic); });
  for (TopicId id = 0; id < topics_.size(); ++id) {
    Content& content = contents_[id];
    if (!content.changed || !is_due(id)) continue;
    if (encode(content)) updates.push_back({id, content.newest});
  }
  return updates;
}

std::vector<TopicBoard::Update> TopicBoard::take_due(std::int64_t wall_us,
                                                     const std::function<bool(TopicId)>& wanted) {
  return take(wanted, [&](TopicId id) {
    Content& content = contents_[id];
    if (wall_us < content.encoded_wall_us + topics_[id].period_us || !wanted(id)) return false;
    content.encoded_wall_us = wall_us;
    return true;
  });
}

std::vector<TopicBoard::Update> TopicBoard::take_changed() {
  const auto all = [](TopicId) { return true; };
  return take(all, all);
}

std::vector<TopicMessage> TopicBoard::current(TopicId topic) {
  Content& content = contents_.at(topic);
  std::vector<TopicMessage> messages;
  if (topics_[topic].retention == Retention::kAppended) {
    for (const Kept& kept : content.kept) messages.push_back(kept.message);
    return messages;
  }
  if (content.changed) encode(content);
  if (content.newest.bytes) messages.push_back(content.newest);
  return messages;
}

}  // namespace adit
