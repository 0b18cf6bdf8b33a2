// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/sensing/laser_scan.hpp"

namespace adit {

/// What the robot is at. The four of the paper follow each other; motion is only in kExecute.
enum class Phase : std::int8_t {
  kWaiting = 0,  ///< for stages, for the pose, or to know where it is on its map
  kExplore = 1,  ///< the next place is chosen
  kScan = 2,     ///< it rests and sweeps a laser
  kPlan = 3,     ///< a path is looked for
  kExecute = 4,  ///< it follows the path
  kPaused = 5,   ///< by order
  kEnded = 6,    ///< the mission is over
};

/// How a mission ended.
enum class MissionOutcome : std::int8_t {
  kInProgress = 0,
  kHome = 1,      ///< it stands where it started
  kStopped = 2,   ///< by order
  kStranded = 3,  ///< it stands somewhere and no way was found any more
};

/// How a mission stands. What led to the present phase is in `reason`.
struct MissionPhase {
  std::int64_t utime = 0;     ///< of the change to this phase [µs since the epoch]
  std::int32_t sequence = 0;  ///< counts the changes of a mission, over restarts too
  Phase phase = Phase::kWaiting;
  std::string reason;               ///< for the change, a sentence
  bool returning_home = false;      ///< it has turned around
  std::string return_home_reason;   ///< a sentence; empty while it has not
  LaserId laser = LaserId::kFront;  ///< that looks where the robot is going
  std::int32_t goal_id = 0;  ///< of the scan, the goal and the path at hand; 0 before the first
  std::optional<std::int32_t>
      frontier;            ///< id of the target; empty: home, or no target of exploration
  std::int32_t scans = 0;  ///< 3D scans taken
  double distance_travelled_m = 0.0;
  double remaining_m = 0.0;  ///< way that battery and time still allow
  MissionOutcome outcome = MissionOutcome::kInProgress;
  bool complete = false;  ///< every stub ever seen is closed, each with its evidence

  friend bool operator==(const MissionPhase&, const MissionPhase&) = default;
};

/// What a person orders a mission to do.
struct MissionOrder {
  enum class Kind : std::int8_t {
    kPause = 0,       ///< stand, until told to go on
    kResume = 1,      ///< after a pause
    kReturnHome = 2,  ///< turn around for good
    kStop = 3,        ///< stand, and end the mission where it is
  };

  std::int64_t utime = 0;  ///< [µs since the epoch]
  Kind kind = Kind::kPause;

  friend bool operator==(const MissionOrder&, const MissionOrder&) = default;
};

}  // namespace adit
