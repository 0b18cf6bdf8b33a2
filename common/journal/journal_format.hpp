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

/// What a journal holds, as it lies there: valid as long as the bytes it was read from.
struct JournalRecord {
  static constexpr std::size_t kKindMax = 63;  ///< characters, at least one
  static constexpr std::size_t kBytesMax = 1'000'000'000;

  std::string_view kind;  ///< what the bytes are, e.g. a channel
  std::span<const std::uint8_t> bytes;
};

namespace journal_format {

inline constexpr std::string_view kMagic = "ADJ1";  ///< begins each record
inline constexpr std::size_t kHeaderBytes = 20;

/// The record as it goes to the disk. Throws std::length_error for what a record cannot hold.
std::vector<std::uint8_t> write(const JournalRecord& record);

/// Bytes of the record that begins here, head and all, whether they are there or not; nothing where
/// no whole and sound head is.
std::optional<std::size_t> size(std::span<const std::uint8_t> bytes);

/// The record that begins here; nothing where it is not whole and sound.
std::optional<JournalRecord> read(std::span<const std::uint8_t> bytes);

}  // namespace journal_format

/// What was found in a journal beside its records.
struct JournalHealth {
  std::size_t records = 0;
  std::size_t corrupt_regions = 0;  ///< each a record or more that cannot be read
  std::size_t corrupt_bytes = 0;    ///< in these
  std::size_t truncated_bytes = 0;  ///< of a last record whose end is missing

  friend bool operator==(const JournalHealth&, const JournalHealth&) = default;
};

/// Finds the records in the bytes of a journal, in order, whatever the bytes are. What is no record
/// is passed over up to the next one, and counted.
class JournalParser {
 public:
  explicit JournalParser(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  /// The next record, or nothing at the end. It points into the bytes.
  std::optional<JournalRecord> next();

  /// Of what was read so far.
  [[nodiscard]] const JournalHealth& health() const { return health_; }

 private:
  [[nodiscard]] std::size_t find_record(std::size_t from) const;
  void skip_tail();

  std::span<const std::uint8_t> bytes_;
  std::size_t position_ = 0;
  JournalHealth health_;
};

/// Whether bytes without any record may yet be those of a journal: none, the beginning of one that
/// was torn or damaged, or the zeros that a computer leaves that died before it wrote.
bool may_be_journal(std::span<const std::uint8_t> bytes);

}  // namespace adit
