// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/mission_leave.hpp"

namespace adit {

void MissionLeave::hear(const MissionPhase& phase, std::int64_t utime) {
  phase_ = phase;
  utime_ = utime;
}

std::optional<std::string> MissionLeave::refusal(std::int64_t utime, std::int32_t path_id) const {
  if (!phase_) return std::nullopt;
  if (utime - utime_ > kStaleUs) return "the mission is silent";
  if (phase_->phase != Phase::kExecute) return "the mission is not executing a path";
  if (phase_->goal_id != path_id) return "the mission means another path";
  return std::nullopt;
}

}  // namespace adit
