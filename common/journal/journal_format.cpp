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

// Offsets in the header. The place is in the new format only.
constexpr std::size_t kKindLength = 4;
constexpr std::size_t kDataLength = 8;
constexpr std::size_t kBodyCrc = 12;
constexpr std::size_t kSequence = 16;
constexpr std::size_t kPrevious = 20;
constexpr std::size_t kCrcBytes = 4;  // of the header, at its end

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

/// Bytes of the header that begins here, by its magic; 0 for other bytes.
std::size_t header_bytes(Bytes bytes) {
  const std::string_view text = text_of(bytes);
  if (text.starts_with(kMagic)) return kHeaderBytes;
  return text.starts_with(kMagicOld) ? kHeaderBytesOld : 0;
}

}  // namespace

std::vector<std::uint8_t> write(const JournalRecord& record, const Place& place) {
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
  put(place.sequence, kSequence, bytes);
  put(place.previous, kPrevious, bytes);
  constexpr std::size_t kHeaderCrc = kHeaderBytes - kCrcBytes;
  put(crc_of(Bytes(bytes).first(kHeaderCrc)), kHeaderCrc, bytes);
  return bytes;
}

std::uint32_t checksum_of(std::span<const std::uint8_t> encoded) {
  return number(encoded, header_bytes(encoded) - kCrcBytes);
}

std::optional<std::size_t> size(std::span<const std::uint8_t> bytes) {
  const std::size_t header = header_bytes(bytes);
  if (header == 0 || bytes.size() < header) return std::nullopt;
  const std::size_t checked = header - kCrcBytes;
  if (crc_of(bytes.first(checked)) != number(bytes, checked)) return std::nullopt;
  const std::size_t kind_length = number(bytes, kKindLength);
  const std::size_t data_length = number(bytes, kDataLength);
  if (!is_valid_length(kind_length, data_length)) return std::nullopt;
  return header + kind_length + data_length;
}

std::optional<StoredRecord> read(std::span<const std::uint8_t> bytes) {
  const std::optional<std::size_t> length = size(bytes);
  if (!length || *length > bytes.size()) return std::nullopt;
  const std::size_t header = header_bytes(bytes);
  const Bytes body = bytes.first(*length).subspan(header);
  if (crc_of(body) != number(bytes, kBodyCrc)) return std::nullopt;
  const std::size_t kind_length = number(bytes, kKindLength);
  StoredRecord stored{{text_of(body.first(kind_length)), body.subspan(kind_length)},
                      std::nullopt,
                      checksum_of(bytes),
                      *length};
  if (header == kHeaderBytes) stored.place = {number(bytes, kSequence), number(bytes, kPrevious)};
  return stored;
}

}  // namespace adit::journal_format

namespace adit {
namespace {

using Bytes = std::span<const std::uint8_t>;
using journal_format::kHeaderBytes;
using journal_format::kMagic;
using journal_format::kMagicOld;

constexpr std::string_view kMagicStart = kMagic.substr(0, 3);  // that of both formats
static_assert(kMagicOld.starts_with(kMagicStart));

bool is_start_of(Bytes bytes, std::string_view magic) {
  const std::size_t length = std::min(bytes.size(), magic.size());
  return std::equal(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length),
                    magic.begin());
}

/// True if the bytes begin with a magic, as far as they go.
bool starts_like_record(Bytes bytes) {
  return is_start_of(bytes, kMagic) || is_start_of(bytes, kMagicOld);
}

/// True if the bytes are a record without its end.
bool is_truncated(Bytes bytes) {
  const std::size_t header =
      is_start_of(bytes, kMagic) ? kHeaderBytes : journal_format::kHeaderBytesOld;
  if (bytes.size() < header) return starts_like_record(bytes);
  return journal_format::size(bytes).value_or(0) > bytes.size();
}

bool are_zeros(Bytes bytes) {
  return std::all_of(bytes.begin(), bytes.end(), [](std::uint8_t byte) { return byte == 0; });
}

/// True if the bytes after some records are one without its end, or zeros: space that was reserved.
/// Zeros alone may be a journal that is lost.
bool is_unwritten(Bytes bytes, const std::vector<JournalScan::Found>& records) {
  return is_truncated(bytes) || (!records.empty() && are_zeros(bytes));
}

/// The first intact record from an offset on; nothing if there is none.
std::optional<JournalScan::Found> find_record(Bytes bytes, std::size_t from) {
  auto at = bytes.begin() + static_cast<std::ptrdiff_t>(from);
  while (true) {
    at = std::search(at, bytes.end(), kMagicStart.begin(), kMagicStart.end());
    if (at == bytes.end()) return std::nullopt;
    const auto offset = static_cast<std::size_t>(at - bytes.begin());
    if (const auto stored = journal_format::read(bytes.subspan(offset))) {
      return JournalScan::Found{*stored, offset};
    }
    ++at;
  }
}

/// The place of a record of the old format, by its position in the file.
journal_format::Place place_after(const std::vector<JournalScan::Found>& records, bool after_gap) {
  const std::uint32_t skipped = after_gap ? 1 : 0;
  if (records.empty()) return {skipped, 0};
  return {records.back().sequence() + 1 + skipped, records.back().checksum};
}

}  // namespace

bool JournalScan::end_is_corrupt() const {
  if (corrupt.empty()) return false;
  return records.empty() || corrupt.back().offset > records.back().offset;
}

JournalScan scan_journal(std::span<const std::uint8_t> bytes) {
  JournalScan scan;
  scan.bytes = bytes.size();
  std::size_t position = 0;
  while (position < bytes.size()) {
    auto found = find_record(bytes, position);
    const std::size_t start = found ? found->offset : bytes.size();
    if (!found && is_unwritten(bytes.subspan(position), scan.records)) {
      scan.truncated_bytes = bytes.size() - position;
      break;
    }
    const bool after_gap = start > position;
    if (after_gap) scan.corrupt.push_back({position, start - position});
    if (!found) break;
    position = start + found->size;
    if (!found->place) {
      scan.has_old_records = true;
      found->place = place_after(scan.records, after_gap);
    }
    scan.records.push_back(*found);
  }
  return scan;
}

bool may_be_journal(std::span<const std::uint8_t> bytes) {
  return starts_like_record(bytes) || are_zeros(bytes);
}

}  // namespace adit
