// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/journal/journal_format.hpp"

namespace adit {

/// Integrity of a journal, over all its copies.
struct JournalHealth {
  std::size_t records = 0;          ///< intact, in at least one copy
  std::size_t corrupt_regions = 0;  ///< each holds one or more unreadable records
  std::size_t corrupt_bytes = 0;    ///< in all corrupt regions
  std::size_t truncated_bytes = 0;  ///< of incomplete last records
  std::size_t missing = 0;          ///< records that no copy has, between others
  bool end_missing = false;         ///< no copy tells how many records followed the last one
  std::size_t recovered = 0;        ///< records taken from one copy that the other had lost
  std::size_t behind = 0;           ///< records at the end that one copy lacked
  std::size_t misplaced = 0;        ///< duplicates, records out of order, or of another journal
  std::size_t first_damage = 0;     ///< offset of the first damage in the file or its copy [bytes]

  /// Whether records are lost.
  [[nodiscard]] bool has_loss() const { return missing > 0 || end_missing; }
  /// Whether a disk or a person has changed what was written. A power loss alone leaves an
  /// incomplete last record, or one copy behind the other: that is no damage.
  [[nodiscard]] bool is_damaged() const {
    return has_loss() || corrupt_regions > 0 || misplaced > 0 || recovered > 0;
  }

  friend bool operator==(const JournalHealth&, const JournalHealth&) = default;
};

/// In one line, e.g. "1 place damaged (231 bytes, from byte 4711), 2 records lost"; empty for an
/// intact journal.
std::string text_of(const JournalHealth& health);

/// The records of a journal from all its copies.
struct JournalContents {
  std::vector<JournalScan::Found> records;  ///< in order of their sequence, each once
  JournalHealth health;
};

/// Joins what the copies of a journal hold. Of two different records with the same sequence the one
/// in the longer chain of checksums counts.
JournalContents join_copies(std::span<const JournalScan> copies);

}  // namespace adit
