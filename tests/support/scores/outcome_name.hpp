// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/types/mission.hpp"

namespace adit::test {

/// Name of an outcome in a table of missions that have a time limit.
constexpr const char* outcome_name(MissionOutcome outcome) {
  switch (outcome) {
    case MissionOutcome::kInProgress:
      return "timed out";
    case MissionOutcome::kHome:
      return "home";
    case MissionOutcome::kHomeUncertain:
      return "home uncertain";
    case MissionOutcome::kStopped:
      return "stopped";
    case MissionOutcome::kStranded:
      return "stranded";
  }
  return "";
}

}  // namespace adit::test
