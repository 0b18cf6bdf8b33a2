// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "common/journal/journal.hpp"
#include "common/mission/mission_phase.hpp"

namespace adit {

/// How the mission stands, on the disk, so that it goes on after a restart: each change of phase,
/// as messages PHASE.
class MissionJournal {
 public:
  /// Opens or creates it. Throws std::runtime_error where the file is no journal or cannot be used.
  explicit MissionJournal(const std::filesystem::path& path);

  /// The last phase that was there when it was opened.
  [[nodiscard]] const std::optional<MissionPhase>& last() const { return last_; }
  /// When the mission began [µs since the epoch]; 0 for one that has not.
  [[nodiscard]] std::int64_t begun_utime() const { return begun_utime_; }

  /// Returns when the disk has it.
  void append(const MissionPhase& phase);

 private:
  std::optional<MissionPhase> last_;
  std::int64_t begun_utime_ = 0;
  Journal journal_;
};

}  // namespace adit
