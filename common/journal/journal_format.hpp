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

inline constexpr std::string_view kMagic = "ADJ2";     ///< begins each record
inline constexpr std::string_view kMagicOld = "ADJ1";  ///< of release 0.2.0, without a place
inline constexpr std::size_t kHeaderBytes = 28;
inline constexpr std::size_t kHeaderBytesOld = 20;

/// Where a record belongs in its journal.
struct Place {
  std::uint32_t sequence = 0;  ///< number of records before
  std::uint32_t previous = 0;  ///< checksum of the record before; 0 for the first one

  friend bool operator==(const Place&, const Place&) = default;
};

/// An intact record, in place.
struct StoredRecord {
  JournalRecord record;
  std::optional<Place> place;  ///< nothing in the old format
  std::uint32_t checksum = 0;  ///< of header, place and, by the checksum in the header, data
  std::size_t size = 0;        ///< bytes, including the header
};

/// The encoded record. Throws std::length_error if the record exceeds the limits.
std::vector<std::uint8_t> write(const JournalRecord& record, const Place& place);

/// The checksum that names an encoded record as the previous one of the next.
std::uint32_t checksum_of(std::span<const std::uint8_t> encoded);

/// Size of the record that begins here, including its header, even if its end is missing; nothing
/// without an intact header.
std::optional<std::size_t> size(std::span<const std::uint8_t> bytes);

/// The record that begins here; nothing if it is incomplete or damaged.
std::optional<StoredRecord> read(std::span<const std::uint8_t> bytes);

}  // namespace journal_format

/// Bytes of a file that belong to no intact record.
struct JournalRegion {
  std::size_t offset = 0;
  std::size_t bytes = 0;
};

/// What one file holds.
struct JournalScan {
  /// An intact record, and where it lies in the file. Records of the old format are numbered as
  /// they lie, one number being left out where bytes between them are damaged.
  struct Found : journal_format::StoredRecord {
    std::size_t offset = 0;
    [[nodiscard]] std::uint32_t sequence() const { return place->sequence; }
  };

  std::vector<Found> records;          ///< in the order of the file
  std::vector<JournalRegion> corrupt;  ///< each holds one or more unreadable records
  std::size_t truncated_bytes = 0;     ///< of an incomplete last record, or zeros there
  std::size_t bytes = 0;               ///< all
  bool has_old_records = false;

  /// Whether bytes after the last intact record are damaged, so that it may not have been the last.
  [[nodiscard]] bool end_is_corrupt() const;
};

/// Finds the records in arbitrary bytes, to which the result refers.
JournalScan scan_journal(std::span<const std::uint8_t> bytes);

/// True if bytes without an intact record may be a journal: empty, the beginning of a truncated or
/// damaged record, or the zeros that a power loss leaves before data is written.
bool may_be_journal(std::span<const std::uint8_t> bytes);

}  // namespace adit
