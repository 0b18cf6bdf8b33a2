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

/// How the mission stands, on the disk, so that it goes on after a restart: each change of phase,
/// as messages PHASE, and each place of its own track.
class MissionJournal {
 public:
  /// Opens or creates it. Throws std::runtime_error where the file is no journal or cannot be used.
  explicit MissionJournal(const std::filesystem::path& path);

  /// The last phase that was there when it was opened.
  [[nodiscard]] const std::optional<MissionPhase>& last() const { return last_; }
  /// When the mission began [µs since the epoch]; 0 for one that has not.
  [[nodiscard]] const std::optional<std::int64_t>& start_utime() const { return start_utime_; }

  /// The places of the own track that were there, in the order of the way. Once.
  [[nodiscard]] std::vector<StoredPathPose> take_stored_path() { return std::move(track_); }

  /// Returns when the disk has it.
  void append(const MissionPhase& phase);
  /// Survives the process at once, and the computer with the next phase.
  void append(const StoredPathPose& place);

 private:
  std::optional<MissionPhase> last_;
  std::optional<std::int64_t> start_utime_;
  std::vector<StoredPathPose> track_;
  Journal journal_;
};

}  // namespace adit
