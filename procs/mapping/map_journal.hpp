// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <utility>
#include <vector>

#include "common/journal/journal.hpp"
#include "common/types/association.hpp"
#include "common/types/local_map.hpp"
#include "procs/mapping/mapping.hpp"

namespace adit {

/// The map on the disk, as messages LOCAL_MAP and ASSOCIATION: each local map is there, decisions
/// included, before anybody hears of it. Of the one that is being made there are parts, in records
/// LOCAL_MAP_PART, each a LOCAL_MAP with the scans since the part before.
class MapJournal {
 public:
  /// Opens or creates it. Throws std::runtime_error where the file is no journal or cannot be used.
  explicit MapJournal(const std::filesystem::path& path);

  /// What was there when it was opened. Once.
  StoredMap take_restored() { return std::move(restored_); }

  /// Returns when the disk has it.
  void append(const MapUpdate& update);

  /// What there is by now of the local map that is being made, in order of time. Returns when the
  /// disk has it; writes only what it has not.
  void append_unfinished(const LocalMap& map);

 private:
  /// What of an unfinished local map is written.
  struct Parts {
    int id = -1;
    std::int64_t utime = 0;  ///< of its first scan; one that takes the place of another has its id
    int parts = 0;
    std::size_t scans = 0;
  };

  StoredMap restored_;
  Parts parts_;
  Journal journal_;
};

/// Reads one that may be in use. Local maps after one that is lost or damaged are left out, with
/// the decisions on them: a chain with a gap holds nothing together.
StoredMap read_map_journal(const std::filesystem::path& path);

}  // namespace adit
