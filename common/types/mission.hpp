// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/sensing/laser_scan.hpp"

namespace adit {

/// Phase of the mission. The four phases of the paper follow each other; the robot moves only in
/// kExecute.
enum class Phase : std::int8_t {
  kWaiting = 0,  ///< for stages, the pose, or localization on the stored map
  kExplore = 1,  ///< exploration chooses the next goal
  kScan = 2,     ///< the robot stands and takes a 3D scan
  kPlan = 3,     ///< planning computes a path
  kExecute = 4,  ///< the robot follows the path
  kPaused = 5,   ///< by operator order
  kEnded = 6,    ///< the mission is over
};

/// "waiting", "explore", ..: for logs, reports and progress lines.
constexpr const char* name_of(Phase phase) {
  switch (phase) {
    case Phase::kWaiting:
      return "waiting";
    case Phase::kExplore:
      return "explore";
    case Phase::kScan:
      return "scan";
    case Phase::kPlan:
      return "plan";
    case Phase::kExecute:
      return "execute";
    case Phase::kPaused:
      return "paused";
    case Phase::kEnded:
      return "ended";
  }
  return "";
}

/// How a mission ended.
enum class MissionOutcome : std::int8_t {
  kInProgress = 0,
  kHome = 1,           ///< the robot is back at the start
  kStopped = 2,        ///< by operator order
  kStranded = 3,       ///< the robot has stopped elsewhere without a path to the start
  kHomeUncertain = 4,  ///< at the start by its own estimate, which is too uncertain to be sure
};

/// "in progress", "home", ..
constexpr const char* name_of(MissionOutcome outcome) {
  switch (outcome) {
    case MissionOutcome::kInProgress:
      return "in progress";
    case MissionOutcome::kHome:
      return "home";
    case MissionOutcome::kStopped:
      return "stopped";
    case MissionOutcome::kStranded:
      return "stranded";
    case MissionOutcome::kHomeUncertain:
      return "home uncertain";
  }
  return "";
}

/// State of a mission.
struct MissionPhase {
  std::int64_t utime = 0;     ///< time of the change to this phase [µs since the epoch]
  std::int32_t sequence = 0;  ///< number of phase changes of the mission, across restarts
  Phase phase = Phase::kWaiting;
  std::string reason;               ///< reason for the phase change, a sentence
  bool returning_home = false;      ///< true after the decision to return
  std::string return_home_reason;   ///< reason for the return, a sentence; empty before it
  LaserId laser = LaserId::kFront;  ///< laser that faces the direction of travel
  std::int32_t goal_id = 0;         ///< id of the current scan, goal and path; 0 before the first
  std::optional<std::int32_t> frontier;  ///< id of the target frontier
  std::int32_t scans = 0;                ///< 3D scans taken
  double distance_travelled_m = 0.0;
  double remaining_m = 0.0;  ///< path length allowed by battery and time
  MissionOutcome outcome = MissionOutcome::kInProgress;
  bool complete = false;  ///< every frontier detected so far is closed
  /// For kHome and kHomeUncertain: the distance from the start is less with a probability of 95 %
  /// [m]. Empty if mapping gave no pose.
  std::optional<double> home_within_m = {};

  friend bool operator==(const MissionPhase&, const MissionPhase&) = default;
};

/// Distance travelled up to which a robot has not left the start [m].
inline constexpr double kAtStartM = 0.3;

/// Whether the robot ended where it was put down, without a path into the mine.
inline bool never_left_start(const MissionPhase& last) {
  return last.outcome == MissionOutcome::kHome && last.distance_travelled_m < kAtStartM;
}

/// An operator's order to the mission.
struct MissionOrder {
  enum class Kind : std::int8_t {
    kPause = 0,       ///< stop until kResume
    kResume = 1,      ///< continue after a pause
    kReturnHome = 2,  ///< return to the start; cannot be undone
    kStop = 3,        ///< stop and end the mission
  };

  std::int64_t utime = 0;  ///< [µs since the epoch]
  Kind kind = Kind::kPause;

  friend bool operator==(const MissionOrder&, const MissionOrder&) = default;
};

/// "pause", "resume", "return home", "stop and end the mission".
constexpr const char* name_of(MissionOrder::Kind kind) {
  switch (kind) {
    case MissionOrder::Kind::kPause:
      return "pause";
    case MissionOrder::Kind::kResume:
      return "resume";
    case MissionOrder::Kind::kReturnHome:
      return "return home";
    case MissionOrder::Kind::kStop:
      return "stop and end the mission";
  }
  return "";
}

/// Whether the mission does what was ordered.
inline bool is_executed(MissionOrder::Kind order, const MissionPhase& phase) {
  using Kind = MissionOrder::Kind;
  switch (order) {
    case Kind::kPause:
      return phase.phase == Phase::kPaused;
    case Kind::kResume:
      return phase.phase != Phase::kPaused;
    case Kind::kReturnHome:
      return phase.returning_home;
    case Kind::kStop:
      return phase.phase == Phase::kEnded;
  }
  return false;
}

}  // namespace adit
