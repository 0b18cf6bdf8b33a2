// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/types/mission.hpp"
#include "tools/eval/trajectory_score.hpp"
#include "tools/map/summary.hpp"
#include "tools/report/mission_map.hpp"
#include "tools/report/records/event_record.hpp"
#include "tools/report/records/log_info.hpp"
#include "tools/report/records/phase_record.hpp"
#include "tools/report/records/scan_record.hpp"
#include "tools/report/records/state_record.hpp"

namespace adit {

/// All that was heard of a mission.
struct MissionRecords {
  const LogInfo& log_info;
  const PhaseRecord& phases;
  const MapRecord& map;
  const ScanRecord& scans;
  const EventRecord& events;
  const StateRecord& state;
};

/// Of the phases: how much of the time was theirs.
struct PhaseShare {
  Phase phase = Phase::kWaiting;
  std::size_t times = 0;
  double seconds = 0.0;
  double share = 0.0;  ///< of the mission
};

/// How openings stand at last.
struct FrontierCounts {
  std::size_t found = 0;
  std::size_t closed = 0;
  std::size_t open = 0;
  std::size_t blocked = 0;      ///< of those closed
  std::size_t unconfirmed = 0;  ///< given up, but nobody saw that they are blocked
};

/// The figures of a mission. What a log does not tell is not there.
struct MissionStatistics {
  bool simulated = false;
  std::int64_t from_utime = 0;
  std::int64_t to_utime = 0;
  std::vector<PhaseShare> phases;  ///< those that occur, in the order of Phase
  std::optional<MissionPhase> last;
  std::optional<std::int64_t> homeward_utime;
  std::string return_home_reason;
  double distance_travelled_m = 0.0;   ///< by the mission itself, or else of the path
  double distance_from_start_m = 0.0;  ///< where it stands at last, as the crow flies
  double farthest_m = 0.0;             ///< from the start, likewise
  std::size_t scans = 0;
  std::size_t scans_without_path = 0;
  std::size_t local_maps = 0;
  LoopClosureCounts loop_closures;
  std::size_t revoked = 0;  ///< closures that were in force once and are not now
  std::optional<FrontierCounts> frontiers;
  std::optional<double> explored_m;
  std::optional<TrajectoryScore> score;  ///< against TRUTH
  std::optional<std::string> failure;    ///< of a simulated run; empty: none
  std::size_t stops = 0;
  double stopped_s = 0.0;
  std::size_t restarts = 0;
  std::string version;

  [[nodiscard]] double seconds() const { return 1e-6 * static_cast<double>(to_utime - from_utime); }
};

MissionStatistics mission_statistics(const MissionRecords& records, const MissionMap& map);

/// How it went, in a sentence or a few.
std::string outcome_text(const MissionStatistics& statistics);

/// "explore", "scan", ...
const char* name_of(Phase phase);
/// "home", "stopped", "stranded", "under way".
const char* name_of(MissionOutcome outcome);

}  // namespace adit
