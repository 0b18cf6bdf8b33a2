// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/ros/bag/ros1_bag_reader.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>

#include "tools/ros/bag/field_reader.hpp"
#include "tools/ros/bag/unpack.hpp"

namespace adit {
namespace {

constexpr std::string_view kMagic = "#ROSBAG V";
constexpr std::string_view kVersion = "#ROSBAG V2.0\n";
constexpr std::size_t kHeaderBytesMax = 1 << 16;  // of a record
constexpr std::size_t kChunkBytesMax = std::size_t{1} << 30;

/// Values of the field op.
enum : std::uint8_t {
  kMessageData = 0x02,
  kBagHeader = 0x03,
  kChunk = 0x05,
  kChunkInfo = 0x06,
  kConnection = 0x07,
};

/// The value of a field in the header of a record; nothing if there is none, or if the header is no
/// sequence of fields.
std::optional<std::span<const std::uint8_t>> field(std::span<const std::uint8_t> header,
                                                   std::string_view name) {
  FieldReader reader(header);
  std::optional<std::span<const std::uint8_t>> value;
  while (reader.left() > 0) {
    const auto bytes = reader.bytes(reader.u32());
    if (!reader.ok()) return std::nullopt;
    const std::string_view text = text_of(bytes);
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos) return std::nullopt;
    if (text.substr(0, equals) == name) value = bytes.subspan(equals + 1);
  }
  return value;
}

std::optional<std::uint64_t> number(std::span<const std::uint8_t> header, std::string_view name,
                                    std::size_t size) {
  const auto value = field(header, name);
  if (!value || value->size() != size) return std::nullopt;
  return FieldReader(*value).number(size);
}

std::string text(std::span<const std::uint8_t> header, std::string_view name) {
  return std::string(text_of(field(header, name).value_or(std::span<const std::uint8_t>())));
}

/// The number of messages that the index states for a chunk: pairs of connection and number.
std::size_t messages_in_chunk(const Ros1Record& info) {
  FieldReader reader(info.data);
  std::size_t messages = 0;
  while (reader.left() >= 2 * sizeof(std::uint32_t)) {
    reader.u32();
    messages += reader.u32();
  }
  return messages;
}

}  // namespace

bool is_ros1_bag(std::span<const std::uint8_t> begin) { return text_of(begin).starts_with(kMagic); }

/// `fits`: whether the data ends within the bytes; if not, the record has what there is.
std::optional<Ros1Record> Ros1Records::record_at(std::size_t at, bool& fits) {
  FieldReader reader(bytes_.subspan(at));
  const std::uint32_t header_bytes = reader.u32();
  if (!reader.ok() || header_bytes == 0 || header_bytes > kHeaderBytesMax) return std::nullopt;
  Ros1Record record;
  record.header = reader.bytes(header_bytes);
  const std::uint32_t data_bytes = reader.u32();
  if (!reader.ok()) return std::nullopt;
  const auto op = number(record.header, "op", 1);
  if (!op) return std::nullopt;
  record.op = static_cast<std::uint8_t>(*op);
  fits = data_bytes <= reader.left();
  record.data = reader.bytes(std::min<std::size_t>(data_bytes, reader.left()));
  return record;
}

std::optional<Ros1Record> Ros1Records::next() {
  while (at_ < bytes_.size()) {
    bool fits = true;
    const auto record = record_at(at_, fits);
    if (record && fits) {
      const auto* const end = record->data.data() + record->data.size();
      at_ = static_cast<std::size_t>(end - bytes_.data());
      return record;
    }
    const std::size_t from = at_;
    if (skip_to_next()) {
      ++damage_.corrupt_regions;
      damage_.corrupt_bytes += at_ - from;
      continue;
    }
    damage_.truncated_bytes += bytes_.size() - from;
    truncated_ = record;
    at_ = bytes_.size();
  }
  return std::nullopt;
}

bool Ros1Records::may_continue_with(const Ros1Record& record) {
  if (record.op != kMessageData) return true;
  if (!has_compressed_chunks_) {
    has_compressed_chunks_ = text_of(bytes_).find("compression=bz2") != std::string_view::npos ||
                             text_of(bytes_).find("compression=lz4") != std::string_view::npos;
  }
  return !*has_compressed_chunks_;
}

/// Every record has a field op of one byte; its header begins at most kSearchBytes before.
bool Ros1Records::skip_to_next() {
  constexpr std::array<std::uint8_t, 7> kOp{4, 0, 0, 0, 'o', 'p', '='};
  constexpr std::size_t kSearchBytes = 512;
  const std::size_t from = at_ + 1;
  auto op = bytes_.begin() + static_cast<std::ptrdiff_t>(std::min(from, bytes_.size()));
  while (true) {
    op = std::search(op, bytes_.end(), kOp.begin(), kOp.end());
    if (op == bytes_.end()) return false;
    const auto found = static_cast<std::size_t>(op - bytes_.begin());
    const std::size_t begin = std::max(from, found - std::min(found, kSearchBytes));
    for (std::size_t at = begin; at + sizeof(std::uint32_t) <= found; ++at) {
      bool fits = false;
      const auto record = record_at(at, fits);
      if (record && fits && may_continue_with(*record)) {
        at_ = at;
        return true;
      }
    }
    ++op;
  }
}

Ros1BagReader::Ros1BagReader(std::span<const std::uint8_t> bytes)
    : bytes_(bytes), records_(bytes, std::min(bytes.size(), kVersion.size())) {
  if (!text_of(bytes).starts_with(kVersion)) {
    throw std::runtime_error(
        is_ros1_bag(bytes) ? "a bag of ROS 1 in an old format; rosbag fix makes one in format 2.0"
                           : "no bag of ROS 1");
  }
  read_index();
}

/// The index behind the chunks repeats all connections, so that a damaged chunk does not hide a
/// topic, and has the number of messages. A bag that was not closed has none.
void Ros1BagReader::read_index() {
  Ros1Records begin = records_;
  const auto header = begin.next();
  if (!header || header->op != kBagHeader) return;
  const auto index = number(header->header, "index_pos", sizeof(std::uint64_t));
  if (!index || *index == 0 || *index >= bytes_.size()) return;
  Ros1Records records(bytes_, *index);
  while (const auto record = records.next()) {
    if (record->op == kConnection) add_connection(*record);
    if (record->op == kChunkInfo) expected_ += messages_in_chunk(*record);
  }
}

void Ros1BagReader::add_connection(const Ros1Record& record) {
  const auto id = number(record.header, "conn", sizeof(std::uint32_t));
  const std::string topic = text(record.header, "topic");
  const std::string type = text(record.data, "type");
  if (!id || topic.empty() || type.empty()) return;
  connections_[static_cast<std::uint32_t>(*id)] =
      topics_.index_of({topic, plain_type(type), "ros1"});
}

void Ros1BagReader::open_chunk(const Ros1Record& chunk) {
  const auto compression = compression_of(text(chunk.header, "compression"));
  const auto size = number(chunk.header, "size", sizeof(std::uint32_t));
  if (!compression || !size || *size > kChunkBytesMax) {
    ++damage_.corrupt_regions;
    damage_.corrupt_bytes += chunk.data.size();
    return;
  }
  Unpacked content = unpack(*compression, chunk.data, *size);
  chunk_ = std::move(content.bytes);
  in_chunk_.emplace(chunk_);
  chunk_missing_ = content.whole ? 0 : std::max<std::size_t>(*size - chunk_.size(), 1);
}

void Ros1BagReader::close_chunk() {
  BagDamage part = in_chunk_->damage();
  part.corrupt_bytes += std::exchange(part.truncated_bytes, 0) + chunk_missing_;
  if (part.corrupt_bytes > 0 && part.corrupt_regions == 0) part.corrupt_regions = 1;
  damage_ += part;
  in_chunk_.reset();
}

std::optional<BagMessage> Ros1BagReader::message(const Ros1Record& record) {
  if (record.op == kConnection) add_connection(record);
  if (record.op != kMessageData) return std::nullopt;
  const auto id = number(record.header, "conn", sizeof(std::uint32_t));
  const auto time = number(record.header, "time", sizeof(std::uint64_t));
  const auto topic = id ? connections_.find(static_cast<std::uint32_t>(*id)) : connections_.end();
  if (!time || topic == connections_.end()) {
    ++damage_.lost_messages;
    return std::nullopt;
  }
  ++messages_;
  const std::uint64_t seconds = *time & 0xFFFFFFFFU;  // sec and nsec, 4 bytes each
  const std::uint64_t nanoseconds = *time >> 32U;
  return BagMessage{topic->second,
                    static_cast<std::int64_t>(seconds * 1'000'000 + nanoseconds / 1000),
                    record.data};
}

std::optional<BagMessage> Ros1BagReader::next_in_chunk() {
  while (in_chunk_) {
    const auto record = in_chunk_->next();
    if (!record) {
      close_chunk();
    } else if (const auto found = message(*record)) {
      return found;
    }
  }
  return std::nullopt;
}

std::optional<BagMessage> Ros1BagReader::next() {
  while (true) {
    if (const auto found = next_in_chunk()) return found;
    if (ended_) return std::nullopt;
    const auto record = records_.next();
    if (!record) {
      ended_ = true;
      const auto& truncated = records_.truncated();
      if (truncated && truncated->op == kChunk) open_chunk(*truncated);
    } else if (record->op == kChunk) {
      open_chunk(*record);
    } else if (const auto found = message(*record)) {
      return found;
    }
  }
}

BagDamage Ros1BagReader::damage() const {
  BagDamage all = damage_;
  all += records_.damage();
  if (ended_ && expected_ > messages_) all.lost_messages = expected_ - messages_;
  return all;
}

double Ros1BagReader::fraction_read() const {
  return static_cast<double>(records_.position()) / static_cast<double>(bytes_.size());
}

}  // namespace adit
