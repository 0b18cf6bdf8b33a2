// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "common/journal/journal.hpp"
#include "procs/volume_map/volume_map.hpp"

namespace adit {

/// The volume on the disk: with each scan what its sub-volume then is, as small as a closed one and
/// compressed, and of its points those that are new; and the time of each scan. So the file grows
/// with the scans as the memory does. Also where odom lies, for a scan that comes after a restart.
class VolumeJournal {
 public:
  /// Opens or creates it. Throws std::runtime_error where the file is no journal or cannot be used.
  explicit VolumeJournal(const std::filesystem::path& path);

  /// What was there when it was opened. Once.
  StoredVolumes take_restored() { return std::move(restored_); }

  /// Adds what is new. Returns when the disk has it.
  void store(const VolumeMap& map);

 private:
  struct Written {
    int scans = 0;
    std::size_t points = 0;
    bool anchored = false;
    int replacements = 0;
  };

  void read(const JournalRecord& record);
  void read_volume(const JournalRecord& record);
  bool store_volumes(const VolumeMap& map);
  bool store_times(const VolumeMap& map);
  bool store_odom(const VolumeMap& map);

  StoredVolumes restored_;
  std::vector<Written> written_;   ///< by id
  std::size_t written_times_ = 0;  ///< of scans
  std::optional<AnchoredOdom> written_odom_;
  Journal journal_;
};

}  // namespace adit
