// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "common/journal/journal.hpp"
#include "common/types/association.hpp"
#include "common/types/local_map.hpp"
#include "procs/mapping/mapping.hpp"

namespace adit {

/// Stores the map on disk, as messages LOCAL_MAP, ASSOCIATION and CLOUD_MATCH: each local map is on
/// disk, decisions included, before it is published. The unfinished local map is stored in parts,
/// records LOCAL_MAP_PART, each a LOCAL_MAP with the scans since the previous part.
class MapJournal {
 public:
  /// Opens or creates the file. Throws std::runtime_error if the file is no journal or cannot be
  /// used.
  explicit MapJournal(const std::filesystem::path& path);

  /// The content at the time of opening. May be called once.
  StoredMap take_restored() { return std::move(restored_); }

  /// What to tell a person about the journal as it was opened, in one line; empty if it is intact.
  [[nodiscard]] const std::string& report() const { return report_; }
  /// Whether it was damaged, other than by a power loss.
  [[nodiscard]] bool is_damaged() const { return is_damaged_; }
  /// That of Journal.
  [[nodiscard]] const std::string& failure() const { return journal_.failure(); }

  /// Appends a local map and its decisions. Returns when they are on disk.
  void append(const MapUpdate& update);

  /// Appends decisions on stored local maps.
  void append(const std::vector<Association>& associations);

  /// Appends the new scans of the unfinished local map, in order of time. Returns when they are on
  /// disk.
  void append_unfinished(const LocalMap& map);

 private:
  /// The stored part of an unfinished local map.
  struct Parts {
    int id = -1;
    std::int64_t utime = 0;  ///< of its first scan; a replacement has the same id
    int parts = 0;
    std::size_t scans = 0;
  };

  StoredMap restored_;
  std::string report_;
  bool is_damaged_ = false;
  Parts parts_;
  Journal journal_;
};

/// Reads a journal that may be in use. A local map that is lost is replaced by an empty one, or by
/// its parts, so that the others keep their ids.
StoredMap read_map_journal(const std::filesystem::path& path);

/// What to tell a person about what was read: damage of the file and its copy, and which local maps
/// are lost, in one line; empty for an intact journal.
std::string map_journal_report(const std::filesystem::path& path, const StoredMap& stored);

}  // namespace adit
