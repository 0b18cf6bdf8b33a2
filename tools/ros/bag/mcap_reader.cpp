// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/ros/bag/mcap_reader.hpp"

#include <algorithm>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <zlib.h>

#include "tools/ros/bag/field_reader.hpp"
#include "tools/ros/bag/unpack.hpp"

namespace adit {
namespace {

constexpr std::string_view kMagic("\x89MCAP0\r\n", 8);
constexpr std::size_t kRecordBeginBytes = 9;  // opcode and length
constexpr std::size_t kFooterBytes = 20;
constexpr std::size_t kChunkBytesMax = std::size_t{1} << 30;

/// Opcodes of the records.
enum : std::uint8_t {
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kStatistics = 0x0B,
  kOpcodeMax = 0x0F,
  kDataEnd = 0x0F,
};

/// The record at a place; nothing if none begins there. `fits`: whether it ends within the bytes;
/// if not, it has what there is.
std::optional<McapRecord> record_at(std::span<const std::uint8_t> bytes, std::size_t at,
                                    bool& fits) {
  FieldReader reader(bytes.subspan(at));
  McapRecord record{reader.u8(), {}};
  const std::uint64_t size = reader.u64();
  // Opcodes from 0x80 on are those of other programs.
  if (!reader.ok() || record.opcode == 0 || (record.opcode > kOpcodeMax && record.opcode < 0x80)) {
    return std::nullopt;
  }
  fits = size <= reader.left();
  record.content = fits ? reader.bytes(size) : reader.rest();
  return record;
}

std::size_t end_of(const McapRecord& record, std::span<const std::uint8_t> bytes) {
  return static_cast<std::size_t>(record.content.data() + record.content.size() - bytes.data());
}

struct ChunkHeader {
  std::uint64_t from_ns = 0;
  std::uint64_t to_ns = 0;
  std::uint64_t size = 0;  ///< of the content
  std::uint32_t crc = 0;   ///< 0: none
  std::optional<Compression> compression;
  std::uint64_t packed_size = 0;
  std::span<const std::uint8_t> packed;  ///< as far as there is

  [[nodiscard]] bool is_plausible() const {
    return compression && size <= kChunkBytesMax && from_ns <= to_ns;
  }
};

ChunkHeader chunk_header(std::span<const std::uint8_t> content) {
  FieldReader reader(content);
  ChunkHeader chunk;
  chunk.from_ns = reader.u64();
  chunk.to_ns = reader.u64();
  chunk.size = reader.u64();
  chunk.crc = reader.u32();
  const std::string_view compression = reader.text();
  chunk.packed_size = reader.u64();
  if (!reader.ok()) return {};
  chunk.compression = compression_of(compression);
  chunk.packed = reader.bytes(std::min<std::size_t>(chunk.packed_size, reader.left()));
  return chunk;
}

std::uint32_t crc_of(std::span<const std::uint8_t> bytes) {
  return static_cast<std::uint32_t>(crc32_z(0, bytes.data(), bytes.size()));
}

}  // namespace

bool is_mcap(std::span<const std::uint8_t> begin) { return text_of(begin).starts_with(kMagic); }

McapReader::McapReader(std::span<const std::uint8_t> bytes) : bytes_(bytes), at_(kMagic.size()) {
  if (!is_mcap(bytes)) throw std::runtime_error("no MCAP file");
  read_summary();
}

/// The summary repeats schemas and channels, so that a damaged chunk does not hide a topic, and has
/// the number of messages.
void McapReader::read_summary() {
  const std::size_t end_bytes = kRecordBeginBytes + kFooterBytes + kMagic.size();
  if (bytes_.size() < kMagic.size() + end_bytes) return;
  const auto end = bytes_.last(end_bytes);
  if (!text_of(end).ends_with(kMagic)) return;
  const std::uint64_t summary = FieldReader(end.subspan(kRecordBeginBytes)).u64();
  if (summary == 0 || summary >= bytes_.size()) return;
  bool fits = true;
  for (std::size_t at = summary; at < bytes_.size();) {
    const auto record = record_at(bytes_, at, fits);
    if (!record || !fits) return;
    if (record->opcode == kStatistics) expected_ = FieldReader(record->content).u64();
    if (record->opcode == kSchema || record->opcode == kChannel) take(*record);
    at = end_of(*record, bytes_);
  }
}

void McapReader::add_corrupt(std::size_t bytes) {
  ++damage_.corrupt_regions;
  damage_.corrupt_bytes += bytes;
}

std::optional<BagMessage> McapReader::take(const McapRecord& record) {
  if (record.opcode == kSchema) add_schema(record.content);
  if (record.opcode == kChannel) add_channel(record.content);
  if (record.opcode == kMessage) return message(record.content);
  return std::nullopt;
}

void McapReader::add_schema(std::span<const std::uint8_t> content) {
  FieldReader reader(content);
  const std::uint16_t id = reader.u16();
  const std::string_view name = reader.text();
  if (reader.ok()) schemas_[id] = {plain_type(name)};
}

void McapReader::add_channel(std::span<const std::uint8_t> content) {
  FieldReader reader(content);
  const std::uint16_t id = reader.u16();
  const auto schema = schemas_.find(reader.u16());
  const std::string_view topic = reader.text();
  const std::string_view encoding = reader.text();
  if (!reader.ok()) return;
  const std::string type = schema == schemas_.end() ? "" : schema->second.name;
  channels_[id] = topics_.index_of({std::string(topic), type, std::string(encoding)});
}

std::optional<BagMessage> McapReader::message(std::span<const std::uint8_t> content) {
  FieldReader reader(content);
  const auto topic = channels_.find(reader.u16());
  reader.u32();  // sequence
  const std::uint64_t log_ns = reader.u64();
  reader.u64();  // time of publication
  if (!reader.ok() || topic == channels_.end()) {
    ++damage_.lost_messages;
    return std::nullopt;
  }
  ++messages_;
  return BagMessage{topic->second, static_cast<std::int64_t>(log_ns / 1000), reader.rest()};
}

void McapReader::open_chunk(std::span<const std::uint8_t> content, bool truncated) {
  const ChunkHeader chunk = chunk_header(content);
  if (!chunk.is_plausible()) return add_corrupt(content.size());
  Unpacked unpacked = unpack(*chunk.compression, chunk.packed, chunk.size);
  const bool wrong = chunk.crc != 0 && crc_of(unpacked.bytes) != chunk.crc;
  if (!truncated && (wrong || !unpacked.whole)) return add_corrupt(content.size());
  chunk_ = std::move(unpacked.bytes);
  at_in_chunk_ = 0;
}

std::optional<BagMessage> McapReader::next_in_chunk() {
  while (at_in_chunk_ < chunk_.size()) {
    bool fits = true;
    const auto record = record_at(chunk_, at_in_chunk_, fits);
    if (!record || !fits) {
      // A chunk with its checksum has none; one without, or a truncated one, may.
      if (!ended_) add_corrupt(chunk_.size() - at_in_chunk_);
      break;
    }
    at_in_chunk_ = end_of(*record, chunk_);
    if (const auto found = take(*record)) return found;
  }
  chunk_.clear();
  at_in_chunk_ = 0;
  return std::nullopt;
}

std::optional<BagMessage> McapReader::next() {
  while (true) {
    if (const auto found = next_in_chunk()) return found;
    if (ended_ || at_ >= bytes_.size()) return std::nullopt;
    bool fits = true;
    const auto record = record_at(bytes_, at_, fits);
    if (!record || !fits) {
      const std::size_t from = at_;
      skip_to_chunk();
      if (at_ < bytes_.size()) {
        add_corrupt(at_ - from);
        continue;
      }
      damage_.truncated_bytes += bytes_.size() - from;
      ended_ = true;
      if (record && record->opcode == kChunk) open_chunk(record->content, true);
      continue;
    }
    at_ = end_of(*record, bytes_);
    if (record->opcode == kDataEnd) at_ = bytes_.size();  // the summary follows
    if (record->opcode == kChunk) {
      open_chunk(record->content, false);
    } else if (const auto found = take(*record)) {
      return found;
    }
  }
}

void McapReader::skip_to_chunk() {
  for (++at_; at_ < bytes_.size(); ++at_) {
    if (bytes_[at_] != kChunk) continue;
    bool fits = false;
    const auto record = record_at(bytes_, at_, fits);
    if (!record || !fits) continue;
    const ChunkHeader chunk = chunk_header(record->content);
    const bool ends_with_content = chunk.packed.size() == chunk.packed_size &&
                                   chunk.packed.data() + chunk.packed.size() ==
                                       record->content.data() + record->content.size();
    if (chunk.is_plausible() && ends_with_content) {
      return;
    }
  }
}

BagDamage McapReader::damage() const {
  BagDamage all = damage_;
  if (at_ >= bytes_.size() && expected_ > messages_) all.lost_messages = expected_ - messages_;
  return all;
}

double McapReader::fraction_read() const {
  return static_cast<double>(at_) / static_cast<double>(bytes_.size());
}

}  // namespace adit
