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

/// What the stage knows beside the map.
struct StoredExploration {
  std::int64_t map_utime = 0;  ///< of the first scan of the map that it belongs to; 0 for none
  ExplorationMemory exploration;
  std::optional<ExploreRequest> request;  ///< the newest, without its verdict
  double distance_at_request_m = 0.0;     ///< way when that came
  double distance_travelled_m = 0.0;
};

/// It on the disk, as lines of text: each stub whenever it changed, the barriers, and where the
/// robot was going to. A stub that cannot be read any more counts as explored, and is found anew if
/// it is not.
class ExplorationJournal {
 public:
  /// Opens or creates it. Throws std::runtime_error where the file is no journal or cannot be used.
  explicit ExplorationJournal(const std::filesystem::path& path);

  /// What was there when it was opened.
  [[nodiscard]] const StoredExploration& restored() const { return restored_; }

  /// Adds what changed. Returns when the disk has it, but for the way alone.
  void store(const StoredExploration& stored);

 private:
  struct Written {
    std::int64_t map_utime = 0;
    std::vector<std::string> frontiers;
    std::string barriers;
    std::string target;  ///< of the state, all but the way
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
