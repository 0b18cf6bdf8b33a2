// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/journal/journal_record.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include <zlib.h>

namespace adit::journal_format {
namespace {

using Bytes = std::span<const std::uint8_t>;

// Where the numbers of a head stand.
constexpr std::size_t kKindLength = 4;
constexpr std::size_t kDataLength = 8;
constexpr std::size_t kBodyCrc = 12;
constexpr std::size_t kHeadCrc = 16;

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

bool is_possible(std::size_t kind_length, std::size_t data_length) {
  return kind_length >= 1 && kind_length <= JournalRecord::kKindMax &&
         data_length <= JournalRecord::kBytesMax;
}

}  // namespace

std::vector<std::uint8_t> write(const JournalRecord& record) {
  if (!is_possible(record.kind.size(), record.bytes.size())) {
    throw std::length_error("a record of kind '" + std::string(record.kind.substr(0, 80)) +
                            "' is longer than a journal takes");
  }
  std::vector<std::uint8_t> bytes(kHeadBytes);
  bytes.reserve(kHeadBytes + record.kind.size() + record.bytes.size());
  bytes.insert(bytes.end(), record.kind.begin(), record.kind.end());
  bytes.insert(bytes.end(), record.bytes.begin(), record.bytes.end());
  std::copy(kMagic.begin(), kMagic.end(), bytes.begin());
  put(record.kind.size(), kKindLength, bytes);
  put(record.bytes.size(), kDataLength, bytes);
  put(crc_of(Bytes(bytes).subspan(kHeadBytes)), kBodyCrc, bytes);
  put(crc_of(Bytes(bytes).first(kHeadCrc)), kHeadCrc, bytes);
  return bytes;
}

std::optional<std::size_t> size(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kHeadBytes || !text_of(bytes).starts_with(kMagic)) return std::nullopt;
  if (crc_of(bytes.first(kHeadCrc)) != number(bytes, kHeadCrc)) return std::nullopt;
  const std::size_t kind_length = number(bytes, kKindLength);
  const std::size_t data_length = number(bytes, kDataLength);
  if (!is_possible(kind_length, data_length)) return std::nullopt;
  return kHeadBytes + kind_length + data_length;
}

std::optional<JournalRecord> read(std::span<const std::uint8_t> bytes) {
  const std::optional<std::size_t> length = size(bytes);
  if (!length || *length > bytes.size()) return std::nullopt;
  const Bytes body = bytes.first(*length).subspan(kHeadBytes);
  if (crc_of(body) != number(bytes, kBodyCrc)) return std::nullopt;
  const std::size_t kind_length = number(bytes, kKindLength);
  return JournalRecord{text_of(body.first(kind_length)), body.subspan(kind_length)};
}

}  // namespace adit::journal_format
