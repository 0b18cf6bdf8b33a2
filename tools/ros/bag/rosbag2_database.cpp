// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/ros/bag/rosbag2_database.hpp"

#include <utility>

#include "common/files/file_error.hpp"
#include "common/files/zstd_stream.hpp"

namespace adit {
namespace {

constexpr std::size_t kMessageBytesMax = std::size_t{1} << 28;
constexpr int kIdColumn = 0;
constexpr int kTopicColumn = 1;
constexpr int kTimeColumn = 2;
constexpr int kDataColumn = 3;

/// A recording that was interrupted has a log beside it, which belongs to the content.
Database::Mode mode_for(const std::filesystem::path& path) {
  return std::filesystem::exists(path.string() + "-wal") ? Database::Mode::kRead
                                                         : Database::Mode::kReadFinished;
}

/// The content of a message that is compressed; nothing if it is damaged.
std::optional<std::vector<std::uint8_t>> content_of(std::span<const std::uint8_t> packed) {
  ZstdDecoder decoder(packed);
  std::vector<std::uint8_t> content;
  while (decoder.read(content)) {
    if (content.size() > kMessageBytesMax) return std::nullopt;
  }
  if (decoder.damage().corrupt_regions + decoder.damage().truncated_bytes > 0) return std::nullopt;
  return content;
}

}  // namespace

Rosbag2Database::Rosbag2Database(const std::filesystem::path& path)
    : database_(path, mode_for(path)),
      all_(database_.prepare("SELECT id, topic_id, timestamp, data FROM messages ORDER BY id")) {
  SqlStatement topics =
      database_.prepare("SELECT id, name, type, serialization_format FROM topics ORDER BY id");
  while (topics.step()) {
    ids_[topics.integer(0)] =
        topics_.index_of({topics.text(1), plain_type(topics.text(2)), topics.text(3)});
  }
  SqlStatement last = database_.prepare("SELECT max(id) FROM messages");
  try {
    if (last.step()) max_id_ = last.integer(0);
  } catch (const FileError&) {  // behind damage nothing can be read then
  }
}

bool Rosbag2Database::step() {
  if (one_) return step_alone();
  try {
    return all_.step();
  } catch (const FileError&) {
    ++damage_.corrupt_regions;
    one_ = database_.prepare("SELECT id, topic_id, timestamp, data FROM messages WHERE id = ?");
    return step_alone();
  }
}

bool Rosbag2Database::step_alone() {
  while (last_id_ < max_id_) {
    one_->reset();
    one_->bind(0, ++last_id_);
    try {
      if (one_->step()) return true;
    } catch (const FileError&) {
      ++damage_.lost_messages;
    }
  }
  return false;
}

std::optional<BagMessage> Rosbag2Database::message() {
  const SqlStatement& row = one_ ? *one_ : all_;
  last_id_ = row.integer(kIdColumn);
  const auto topic = ids_.find(row.integer(kTopicColumn));
  auto data = row.bytes(kDataColumn);
  if (is_zstd(data)) {
    auto content = content_of(data);
    unpacked_ = content ? std::move(*content) : std::vector<std::uint8_t>();
    data = unpacked_;
  }
  if (topic == ids_.end() || data.empty()) {
    ++damage_.lost_messages;
    return std::nullopt;
  }
  return BagMessage{topic->second, row.integer(kTimeColumn) / 1000, data};
}

std::optional<BagMessage> Rosbag2Database::next() {
  while (step()) {
    if (const auto found = message()) return found;
  }
  return std::nullopt;
}

double Rosbag2Database::fraction_read() const {
  return max_id_ > 0 ? static_cast<double>(last_id_) / static_cast<double>(max_id_) : 1.0;
}

}  // namespace adit
