// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/records/event_record.hpp"
#include "common/records/time_budget.hpp"
#include "common/sensing/seconds.hpp"
#include "common/types/exploration.hpp"
#include "common/types/mission.hpp"
#include "tools/eval/map_consistency.hpp"
#include "tools/eval/trajectory_score.hpp"
#include "tools/map/doubt_list.hpp"
#include "tools/map/summary.hpp"
#include "tools/report/mission_map.hpp"
#include "tools/report/records/log_info.hpp"
#include "tools/report/records/phase_record.hpp"
#include "tools/report/records/scan_record.hpp"
#include "tools/report/records/state_record.hpp"

namespace adit {

/// Everything that is read from the logs of a mission.
struct MissionRecords {
  const LogInfo& log_info;
  const PhaseRecord& phases;
  const MapRecord& map;
  const ScanRecord& scans;
  const EventRecord& events;
  const StateRecord& state;
};

/// Time spent in one phase.
struct PhaseShare {
  Phase phase = Phase::kWaiting;
  std::size_t times = 0;
  double duration_s = 0.0;
  double share = 0.0;  ///< of the duration of all phases
};

/// Frontiers at the end of the log, by state.
struct FrontierCounts {
  std::size_t found = 0;
  std::size_t closed = 0;
  std::size_t open = 0;
  std::size_t blocked = 0;      ///< of those closed
  std::size_t unconfirmed = 0;  ///< of those open: abandoned without evidence that they are blocked
  std::size_t visitable = 0;    ///< of those open: they may still be visited
};

/// Figures of a mission. Optional ones are empty if the log lacks their channels.
struct MissionStatistics {
  bool simulated = false;
  std::int64_t from_utime = 0;
  std::int64_t to_utime = 0;
  std::vector<PhaseShare> phases;  ///< those that occur, in the order of Phase
  TimeBudget budget;
  std::optional<MissionPhase> last;
  std::optional<std::int64_t> return_home_utime;
  std::string return_home_reason;
  double distance_travelled_m = 0.0;   ///< from PHASE, otherwise the length of the path
  double distance_from_start_m = 0.0;  ///< straight-line distance at the end
  double farthest_m = 0.0;             ///< maximum of that distance
  std::size_t scans = 0;
  std::size_t scans_without_path = 0;
  std::size_t local_maps = 0;
  LoopClosureCounts loop_closures;
  std::size_t revoked = 0;  ///< loop closures that were accepted and revoked later
  /// On which the map contradicts itself at the end.
  std::vector<DoubtfulStretch> contradictory;
  std::optional<FrontierCounts> frontiers;
  std::optional<double> explored_m;
  std::optional<TrajectoryScore> score;       ///< against TRUTH
  std::optional<MapConsistency> consistency;  ///< of the local maps with TRUTH
  std::optional<std::string> failure;         ///< of a simulated run: a collision; empty: none
  std::size_t stops = 0;
  double stopped_s = 0.0;
  std::size_t restarts = 0;
  std::string version;

  [[nodiscard]] double duration_s() const { return seconds(to_utime - from_utime); }
};

MissionStatistics mission_statistics(const MissionRecords& records, const MissionMap& map);

/// Outcome of a mission in one to four sentences.
std::string outcome_text(const MissionStatistics& statistics);

/// What the time went to, in the order of Activity: "35 % driving on new ground, ..". Activities of
/// less than a percent are left out. Empty without PHASE.
std::string time_text(const TimeBudget& budget);

/// The errors against TRUTH, beside the allowed ones, in one line; empty without TRUTH.
std::string accuracy_text(const MissionStatistics& statistics);

}  // namespace adit
