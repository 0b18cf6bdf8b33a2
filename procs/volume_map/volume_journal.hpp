// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/journal/journal.hpp"
#include "procs/volume_map/volume_map.hpp"

namespace adit {

/// Stores the volume on disk. Each scan appends the state of its sub-volume, as small as a closed
/// one and compressed, its new points, and the time of the scan, so that the file grows with the
/// scans as the memory does. Also stores the odom frame, for scans that arrive after a restart.
class VolumeJournal {
 public:
  /// Opens or creates the file. Throws std::runtime_error if it is not a journal or cannot be used.
  explicit VolumeJournal(const std::filesystem::path& path);

  /// The stored volumes at the time of opening. May be called once.
  StoredVolumes take_restored() { return std::move(restored_); }

  /// What to tell a person if the file was damaged when it was opened, in one line; empty if not.
  [[nodiscard]] const std::string& damage() const { return journal_.damage(); }
  /// That of Journal.
  [[nodiscard]] const std::string& failure() const { return journal_.failure(); }

  /// Appends what is new, and synchronizes with the disk.
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
  std::size_t written_times_ = 0;  ///< number of scan times
  std::optional<AnchoredOdom> written_odom_;
  Journal journal_;
};

}  // namespace adit
