// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "common/journal/journal.hpp"
#include "common/types/mission.hpp"
#include "procs/mission/traversed_path.hpp"

namespace adit {

/// The state of the mission on disk, from which it resumes after a restart: each change of phase as
/// a PHASE message, and each pose of the traversed path.
class MissionJournal {
 public:
  /// Opens or creates the file. Throws std::runtime_error if it is no journal or cannot be used.
  explicit MissionJournal(const std::filesystem::path& path);

  /// The last phase in the file when it was opened.
  [[nodiscard]] const std::optional<MissionPhase>& last() const { return last_; }
  /// When the mission began [µs since the epoch]; empty for a new mission.
  [[nodiscard]] const std::optional<std::int64_t>& start_utime() const { return start_utime_; }

  /// The poses in the file when it was opened, oldest first. Call it once.
  [[nodiscard]] std::vector<StoredPathPose> take_stored_path() { return std::move(path_); }

  /// Returns when the phase is on disk.
  void append(const MissionPhase& phase);
  /// Survives the process immediately, and a power loss with the next phase.
  void append(const StoredPathPose& pose);

 private:
  std::optional<MissionPhase> last_;
  std::optional<std::int64_t> start_utime_;
  std::vector<StoredPathPose> path_;
  Journal journal_;
};

}  // namespace adit
