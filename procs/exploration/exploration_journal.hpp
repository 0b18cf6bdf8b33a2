// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/journal/journal.hpp"
#include "common/types/exploration.hpp"
#include "procs/exploration/exploration_memory.hpp"

namespace adit {

/// State of the stage beside the map.
struct StoredExploration {
  std::int64_t map_utime = 0;  ///< of the first scan of the map it belongs to; 0 if none
  ExplorationMemory exploration;
  std::vector<ScannedGround> grounds;     ///< of all 3D scans; see append()
  std::optional<ExploreRequest> request;  ///< the newest, without its verdict
  double distance_at_request_m = 0.0;     ///< distance travelled when it arrived
  double distance_travelled_m = 0.0;
};

/// Stores the state on disk as lines of text: each frontier that changed, the barriers, and the
/// target. A frontier that cannot be read counts as explored; it is detected again if it is not.
class ExplorationJournal {
 public:
  /// Opens or creates the file. Throws std::runtime_error if it is not a journal or cannot be used.
  explicit ExplorationJournal(const std::filesystem::path& path);

  /// The stored state at the time of opening.
  [[nodiscard]] const StoredExploration& restored() const { return restored_; }

  /// What to tell a person if the file was damaged when it was opened, in one line; empty if not.
  [[nodiscard]] const std::string& damage() const { return journal_.damage(); }
  /// That of Journal.
  [[nodiscard]] const std::string& failure() const { return journal_.failure(); }

  /// Appends what changed. Synchronizes with the disk, unless only the distance travelled changed.
  /// What 3D scans observed is not stored again.
  void store(const StoredExploration& stored);
  /// Appends what a 3D scan observed, of the map whose first scan has this time.
  void append(std::int64_t map_utime, const ScannedGround& ground);

 private:
  struct Written {
    std::int64_t map_utime = 0;
    std::vector<std::string> frontiers;
    std::string barriers;
    std::string target;  ///< the state without the distance travelled
    std::string state;
  };

  void read(const JournalRecord& record);
  void begin_map(std::int64_t map_utime);
  bool append(std::string_view kind, const std::string& text, std::string& written);

  StoredExploration restored_;
  Written written_;
  Journal journal_;
};

}  // namespace adit
