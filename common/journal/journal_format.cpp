// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/journal/journal_format.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include <zlib.h>

namespace adit::journal_format {
namespace {

using Bytes = std::span<const std::uint8_t>;

// Offsets in the header.
constexpr std::size_t kKindLength = 4;
constexpr std::size_t kDataLength = 8;
constexpr std::size_t kBodyCrc = 12;
constexpr std::size_t kHeaderCrc = 16;

void put(std::size_t value, std::size_t at, std::vector<std::uint8_t>& bytes) {
  for (std::size_t i = 0; i < 4; ++i) {
    bytes[at + i] = static_cast<std::uint8_t>(value >> (24U - 8U * i));
  }
}

std::uint32_t number(Bytes bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (const std::uint8_t byte : bytes.subspan(at, 4)) value = value << 8U | byte;
  return value;
}

std::uint32_t crc_of(Bytes bytes) {
  return static_cast<std::uint32_t>(crc32_z(0, bytes.data(), bytes.size()));
}

std::string_view text_of(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

bool is_valid_length(std::size_t kind_length, std::size_t data_length) {
  return kind_length >= 1 && kind_length <= JournalRecord::kKindMax &&
         data_length <= JournalRecord::kBytesMax;
}

}  // namespace

std::vector<std::uint8_t> write(const JournalRecord& record) {
  if (!is_valid_length(record.kind.size(), record.bytes.size())) {
    throw std::length_error("a record of kind '" + std::string(record.kind.substr(0, 80)) +
                            "' exceeds the size limits of a journal");
  }
  std::vector<std::uint8_t> bytes(kHeaderBytes);
  bytes.reserve(kHeaderBytes + record.kind.size() + record.bytes.size());
  bytes.insert(bytes.end(), record.kind.begin(), record.kind.end());
  bytes.insert(bytes.end(), record.bytes.begin(), record.bytes.end());
  std::copy(kMagic.begin(), kMagic.end(), bytes.begin());
  put(record.kind.size(), kKindLength, bytes);
  put(record.bytes.size(), kDataLength, bytes);
  put(crc_of(Bytes(bytes).subspan(kHeaderBytes)), kBodyCrc, bytes);
  put(crc_of(Bytes(bytes).first(kHeaderCrc)), kHeaderCrc, bytes);
  return bytes;
}

std::optional<std::size_t> size(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kHeaderBytes || !text_of(bytes).starts_with(kMagic)) return std::nullopt;
  if (crc_of(bytes.first(kHeaderCrc)) != number(bytes, kHeaderCrc)) return std::nullopt;
  const std::size_t kind_length = number(bytes, kKindLength);
  const std::size_t data_length = number(bytes, kDataLength);
  if (!is_valid_length(kind_length, data_length)) return std::nullopt;
  return kHeaderBytes + kind_length + data_length;
}

std::optional<JournalRecord> read(std::span<const std::uint8_t> bytes) {
  const std::optional<std::size_t> length = size(bytes);
  if (!length || *length > bytes.size()) return std::nullopt;
  const Bytes body = bytes.first(*length).subspan(kHeaderBytes);
  if (crc_of(body) != number(bytes, kBodyCrc)) return std::nullopt;
  const std::size_t kind_length = number(bytes, kKindLength);
  return JournalRecord{text_of(body.first(kind_length)), body.subspan(kind_length)};
}

}  // namespace adit::journal_format

namespace adit {
namespace {

using Bytes = std::span<const std::uint8_t>;
using journal_format::kHeaderBytes;
using journal_format::kMagic;

/// True if the bytes begin with the magic, as far as they go.
bool starts_like_record(Bytes bytes) {
  const std::size_t length = std::min(bytes.size(), kMagic.size());
  return std::equal(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length),
                    kMagic.begin());
}

/// True if the bytes are a record without its end.
bool is_truncated(Bytes bytes) {
  if (bytes.size() < kHeaderBytes) return starts_like_record(bytes);
  return journal_format::size(bytes).value_or(0) > bytes.size();
}

}  // namespace

std::optional<JournalRecord> JournalParser::next() {
  if (position_ == bytes_.size()) return std::nullopt;
  const std::size_t start = find_record(position_);
  if (start == bytes_.size()) {
    skip_tail();
    return std::nullopt;
  }
  if (start > position_) {
    ++health_.corrupt_regions;
    health_.corrupt_bytes += start - position_;
  }
  ++health_.records;
  const Bytes rest = bytes_.subspan(start);
  position_ = start + journal_format::size(rest).value_or(0);
  return journal_format::read(rest);
}

/// Offset of the first intact record; the end if there is none.
std::size_t JournalParser::find_record(std::size_t from) const {
  auto at = bytes_.begin() + static_cast<std::ptrdiff_t>(from);
  while (true) {
    at = std::search(at, bytes_.end(), kMagic.begin(), kMagic.end());
    const auto start = static_cast<std::size_t>(at - bytes_.begin());
    if (at == bytes_.end() || journal_format::read(bytes_.subspan(start))) return start;
    ++at;
  }
}

void JournalParser::skip_tail() {
  const Bytes tail = bytes_.subspan(position_);
  position_ = bytes_.size();
  if (is_truncated(tail)) {
    health_.truncated_bytes = tail.size();
  } else {
    ++health_.corrupt_regions;
    health_.corrupt_bytes += tail.size();
  }
}

bool may_be_journal(std::span<const std::uint8_t> bytes) {
  return starts_like_record(bytes) ||
         std::all_of(bytes.begin(), bytes.end(), [](std::uint8_t byte) { return byte == 0; });
}

}  // namespace adit
