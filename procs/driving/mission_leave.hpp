// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/mission/mission_phase.hpp"

namespace adit {

/// Whether the mission lets the robot drive: in its phase execute, along the path that it means.
/// Where no mission was ever heard, anybody's path is driven.
class MissionLeave {
 public:
  /// How old the newest word of the mission may be: it comes each second.
  static constexpr std::int64_t kStaleUs = 3'500'000;

  void hear(const MissionPhase& phase, std::int64_t utime);
  /// Why a path may not be driven now; nothing where it may.
  [[nodiscard]] std::optional<std::string> refusal(std::int64_t utime, std::int32_t path_id) const;

 private:
  std::optional<MissionPhase> phase_;
  std::int64_t utime_ = 0;  ///< bus time at which it was heard
};

}  // namespace adit
