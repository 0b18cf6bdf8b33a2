// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "common/journal/journal_record.hpp"

namespace adit {

/// What was found in a journal beside its records.
struct JournalHealth {
  std::size_t records = 0;
  std::size_t corrupt_stretches = 0;  ///< each a record or more that cannot be read
  std::size_t corrupt_bytes = 0;      ///< in these
  std::size_t torn_bytes = 0;         ///< of a last record whose end is missing

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
  void pass_over_the_tail();

  std::span<const std::uint8_t> bytes_;
  std::size_t position_ = 0;
  JournalHealth health_;
};

/// Whether bytes without any record may yet be those of a journal: none, the beginning of one that
/// was torn or damaged, or the zeros that a computer leaves that died before it wrote.
bool may_be_journal(std::span<const std::uint8_t> bytes);

}  // namespace adit
