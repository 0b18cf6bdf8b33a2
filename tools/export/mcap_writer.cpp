// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/export/mcap_writer.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include <zlib.h>

#include "common/files/little_endian.hpp"
#include "common/files/zstd_stream.hpp"

namespace adit {
namespace {

constexpr std::string_view kMagic("\x89MCAP0\r\n", 8);
constexpr std::size_t kChunkBytes = std::size_t{1} << 20;  // of records, before compression
constexpr const char* kLibrary = "adit";

/// Opcodes of the records.
enum : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

/// Appends the fields of a record, little-endian.
class Fields {
 public:
  Fields& number(std::uint64_t value, std::size_t bytes) {
    append_little_endian(bytes_, value, bytes);
    return *this;
  }
  Fields& u16(std::uint64_t value) { return number(value, 2); }
  Fields& u32(std::uint64_t value) { return number(value, 4); }
  Fields& u64(std::uint64_t value) { return number(value, 8); }
  Fields& raw(std::string_view text) {
    bytes_ += text;
    return *this;
  }
  Fields& text(std::string_view text) { return u32(text.size()).raw(text); }
  Fields& strings(const std::map<std::string, std::string>& values) {
    Fields all;
    for (const auto& [key, value] : values) all.text(key).text(value);
    return text(all.bytes_);
  }

  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

std::string record(std::uint8_t opcode, std::string_view content) {
  return Fields().number(opcode, 1).u64(content.size()).raw(content).bytes();
}

std::uint32_t crc(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace

McapWriter::McapWriter(const std::filesystem::path& path, const std::string& profile)
    : new_file_(path), file_(new_file_.part(), path) {
  append(std::string(kMagic));
  append_record(kHeader, Fields().text(profile).text(kLibrary).bytes());
}

void McapWriter::append(const std::string& bytes) {
  file_.write(bytes);
  position_ += bytes.size();
}

void McapWriter::append_record(std::uint8_t opcode, std::string_view content) {
  append(record(opcode, content));
}

std::uint16_t McapWriter::add_channel(const std::string& topic, const std::string& message_encoding,
                                      const Schema& schema,
                                      const std::map<std::string, std::string>& metadata) {
  const std::string schema_fields =
      Fields().text(schema.name).text(schema.encoding).text(schema.data).bytes();
  const auto [known, is_new] = schema_ids_.try_emplace(
      schema_fields, static_cast<std::uint16_t>(schemas_.size() + 1));  // 0: no schema
  if (is_new)
    schemas_.push_back(record(kSchema, Fields().u16(known->second).raw(schema_fields).bytes()));
  const auto id = static_cast<std::uint16_t>(channels_.size());
  channels_.push_back(record(kChannel, Fields()
                                           .u16(id)
                                           .u16(known->second)
                                           .text(topic)
                                           .text(message_encoding)
                                           .strings(metadata)
                                           .bytes()));
  // A reader of a part of the file needs them before the first message.
  if (is_new) chunk_ += schemas_.back();
  chunk_ += channels_.back();
  return id;
}

void McapWriter::write(std::uint16_t channel, std::int64_t log_utime, std::int64_t utime,
                       std::string_view data) {
  const std::uint64_t time_ns = 1000 * static_cast<std::uint64_t>(log_utime);
  const bool first = chunk_index_.empty();
  chunk_from_ns_ = first ? time_ns : std::min(chunk_from_ns_, time_ns);
  chunk_to_ns_ = first ? time_ns : std::max(chunk_to_ns_, time_ns);
  from_ns_ = messages_ == 0 ? time_ns : std::min(from_ns_, time_ns);
  to_ns_ = std::max(to_ns_, time_ns);
  chunk_index_[channel].push_back({time_ns, chunk_.size()});
  const auto sequence = static_cast<std::uint32_t>(counts_[channel]++);
  chunk_ += record(kMessage, Fields()
                                 .u16(channel)
                                 .u32(sequence)
                                 .u64(time_ns)
                                 .u64(1000 * static_cast<std::uint64_t>(utime))
                                 .raw(data)
                                 .bytes());
  ++messages_;
  if (chunk_.size() >= kChunkBytes) end_chunk();
}

void McapWriter::end_chunk() {
  if (chunk_index_.empty()) return;
  const std::string compressed = zstd_frame(chunk_);
  const std::uint64_t chunk_at = position_;
  append_record(kChunk, Fields()
                            .u64(chunk_from_ns_)
                            .u64(chunk_to_ns_)
                            .u64(chunk_.size())
                            .u32(crc(chunk_))
                            .text("zstd")
                            .u64(compressed.size())
                            .raw(compressed)
                            .bytes());
  const std::uint64_t chunk_end = position_;
  Fields offsets;
  for (const auto& [channel, entries] : chunk_index_) {
    offsets.u16(channel).u64(position_);
    Fields times;
    for (const IndexEntry& entry : entries) times.u64(entry.time_ns).u64(entry.offset);
    append_record(kMessageIndex, Fields().u16(channel).text(times.bytes()).bytes());
  }
  chunk_indexes_ += record(kChunkIndex, Fields()
                                            .u64(chunk_from_ns_)
                                            .u64(chunk_to_ns_)
                                            .u64(chunk_at)
                                            .u64(chunk_end - chunk_at)
                                            .text(offsets.bytes())
                                            .u64(position_ - chunk_end)
                                            .text("zstd")
                                            .u64(compressed.size())
                                            .u64(chunk_.size())
                                            .bytes());
  ++chunks_;
  chunk_.clear();
  chunk_index_.clear();
}

void McapWriter::write(const Metadata& metadata) {
  end_chunk();
  const std::uint64_t at = position_;
  append_record(kMetadata, Fields().text(metadata.name).strings(metadata.values).bytes());
  metadata_indexes_ +=
      record(kMetadataIndex, Fields().u64(at).u64(position_ - at).text(metadata.name).bytes());
  ++metadata_;
}

void McapWriter::write_summary() {
  const std::uint64_t summary_at = position_;
  std::string summary;
  Fields offsets;
  const auto add_group = [&](std::uint8_t opcode, const std::string& records) {
    if (records.empty()) return;
    offsets.raw(record(
        kSummaryOffset,
        Fields().number(opcode, 1).u64(summary_at + summary.size()).u64(records.size()).bytes()));
    summary += records;
  };
  const auto joined = [](const std::vector<std::string>& records) {
    std::string all;
    for (const std::string& each : records) all += each;
    return all;
  };
  Fields counts;
  for (const auto& [channel, count] : counts_) counts.u16(channel).u64(count);
  add_group(kSchema, joined(schemas_));
  add_group(kChannel, joined(channels_));
  add_group(kStatistics, record(kStatistics, Fields()
                                                 .u64(messages_)
                                                 .u16(schemas_.size())
                                                 .u32(channels_.size())
                                                 .u32(0)  // attachments
                                                 .u32(metadata_)
                                                 .u32(chunks_)
                                                 .u64(from_ns_)
                                                 .u64(to_ns_)
                                                 .text(counts.bytes())
                                                 .bytes()));
  add_group(kChunkIndex, chunk_indexes_);
  add_group(kMetadataIndex, metadata_indexes_);
  const std::uint64_t offsets_at = summary_at + summary.size();
  summary += offsets.bytes();

  // The checksum covers the summary and the footer up to the checksum.
  const std::string footer = Fields().u64(summary_at).u64(offsets_at).bytes();
  const std::string footer_begin =
      Fields().number(kFooter, 1).u64(footer.size() + sizeof(std::uint32_t)).raw(footer).bytes();
  append(summary + footer_begin + Fields().u32(crc(summary + footer_begin)).bytes());
}

void McapWriter::close() {
  if (chunk_index_.empty()) append(std::exchange(chunk_, {}));  // channels without a message
  end_chunk();
  append_record(kDataEnd, Fields().u32(0).bytes());  // no checksum of all data
  write_summary();
  append(std::string(kMagic));
  file_.close();
  new_file_.publish();
}

}  // namespace adit
