// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/journal/journal.hpp"
#include "common/types/mission.hpp"
#include "procs/mission/traversed_path.hpp"

namespace adit {

/// The newest local map that the mission has seen.
struct NewestLocalMap {
  std::int32_t id = 0;
};

/// The robot does not know any more where home is.
struct HomeUnknown {
  std::string reason;
};

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

  /// Id of the newest local map that the mission had seen.
  [[nodiscard]] const std::optional<int>& newest_local_map() const { return newest_local_map_; }
  /// Why home is not known, if it was stored.
  [[nodiscard]] const std::optional<std::string>& home_unknown() const { return home_unknown_; }

  /// What to tell a person if the file was damaged when it was opened, in one line; empty if not.
  [[nodiscard]] const std::string& damage() const { return journal_.damage(); }
  /// That of Journal.
  [[nodiscard]] const std::string& failure() const { return journal_.failure(); }

  /// Returns when the phase is on disk.
  void append(const MissionPhase& phase);
  /// Survives the process immediately, and a power loss with the next phase.
  void append(const StoredPathPose& pose);
  /// As a pose.
  void append(const NewestLocalMap& map);
  /// Returns when it is on disk.
  void append(const HomeUnknown& home);

 private:
  void read(const JournalRecord& record);

  std::optional<MissionPhase> last_;
  std::optional<std::int64_t> start_utime_;
  std::vector<StoredPathPose> path_;
  std::optional<int> newest_local_map_;
  std::optional<std::string> home_unknown_;
  Journal journal_;
};

/// The last phase in a journal that may be in use, which is not changed.
std::optional<MissionPhase> read_last_phase(const std::filesystem::path& path);
/// The id of the newest local map in it.
std::optional<int> read_newest_local_map(const std::filesystem::path& path);

}  // namespace adit
