// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace adit {

/// A record of a journal, in place: valid as long as the bytes it was read from.
struct JournalRecord {
  static constexpr std::size_t kKindMax = 63;  ///< characters, at least one
  static constexpr std::size_t kBytesMax = 1'000'000'000;

  std::string_view kind;  ///< type of the data, e.g. a channel
  std::span<const std::uint8_t> bytes;
};

namespace journal_format {

inline constexpr std::string_view kMagic = "ADJ1";  ///< begins each record
inline constexpr std::size_t kHeaderBytes = 20;

/// The encoded record. Throws std::length_error if the record exceeds the limits.
std::vector<std::uint8_t> write(const JournalRecord& record);

/// Size of the record that begins here, including its header, even if its end is missing; nothing
/// without an intact header.
std::optional<std::size_t> size(std::span<const std::uint8_t> bytes);

/// The record that begins here; nothing if it is incomplete or damaged.
std::optional<JournalRecord> read(std::span<const std::uint8_t> bytes);

}  // namespace journal_format

/// Integrity of a journal.
struct JournalHealth {
  std::size_t records = 0;
  std::size_t corrupt_regions = 0;  ///< each holds one or more unreadable records
  std::size_t corrupt_bytes = 0;    ///< in all corrupt regions
  std::size_t truncated_bytes = 0;  ///< of an incomplete last record

  friend bool operator==(const JournalHealth&, const JournalHealth&) = default;
};

/// Finds the records in arbitrary bytes, in order. Bytes that are not part of an intact record are
/// skipped and counted.
class JournalParser {
 public:
  explicit JournalParser(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  /// The next record, or nothing at the end. It refers to the parsed bytes.
  std::optional<JournalRecord> next();

  /// Integrity of the bytes read so far.
  [[nodiscard]] const JournalHealth& health() const { return health_; }

 private:
  [[nodiscard]] std::size_t find_record(std::size_t from) const;
  void skip_tail();

  std::span<const std::uint8_t> bytes_;
  std::size_t position_ = 0;
  JournalHealth health_;
};

/// True if bytes without an intact record may be a journal: empty, the beginning of a truncated or
/// damaged record, or the zeros that a power loss leaves before data is written.
bool may_be_journal(std::span<const std::uint8_t> bytes);

}  // namespace adit
