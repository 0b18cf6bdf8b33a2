// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "tests/support/journals/journal_damage.hpp"

namespace adit::test {

/// What a stage makes of its damaged journal.
enum class DamageOutcome {
  kUnchanged,       ///< the damage changed nothing, e.g. zeros where there were zeros
  kRight,           ///< nothing is lost
  kReported,        ///< something is lost, and a line says what
  kOlder,           ///< both copies end at the same record, as they did at an earlier time
  kUnreportedLoss,  ///< something is lost, and no line says so
  kFalseHome,       ///< the map claims a pose relative to home that is more than 0.5 m wrong
};

struct DamagedCase {
  std::string stage;
  JournalDamage damage;
  DamageOutcome outcome = DamageOutcome::kUnchanged;
  std::string report;  ///< the line of the stage
};

/// Damages the journals of an interrupted mission and lets the stages open them, as they do when
/// they resume. The map is restored as `adit map --resume` does, without what follows.
class DamagedStages {
 public:
  /// The folder of the mission, which is not changed, and a folder to work in.
  DamagedStages(const std::filesystem::path& mission, std::filesystem::path scratch);
  ~DamagedStages();

  /// The same seed gives the same case.
  DamagedCase run(unsigned seed);

  /// Stages with a journal that has records.
  [[nodiscard]] std::vector<std::string> stages() const;

 private:
  struct Intact;

  std::filesystem::path mission_;
  std::filesystem::path scratch_;
  std::vector<std::unique_ptr<Intact>> intact_;  ///< by stage
};

/// Copies an interrupted mission, whose logs are linked.
void copy_mission(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace adit::test
