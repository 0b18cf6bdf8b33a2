// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/mission_statistics.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include "common/bus/channels.hpp"
#include "tools/map/map_files.hpp"
#include "tools/report/html/text_format.hpp"

namespace adit {
namespace {

std::vector<PhaseShare> phase_shares(const std::vector<PhaseInterval>& intervals) {
  std::map<Phase, PhaseShare> shares;
  double all_s = 0.0;
  for (const PhaseInterval& interval : intervals) {
    PhaseShare& share = shares[interval.phase.phase];
    share.phase = interval.phase.phase;
    ++share.times;
    share.seconds += interval.seconds();
    all_s += interval.seconds();
  }
  std::vector<PhaseShare> found;
  for (auto& [phase, share] : shares) {
    share.share = all_s > 0.0 ? share.seconds / all_s : 0.0;
    found.push_back(share);
  }
  return found;
}

void add_distances(const MissionRecords& records, const MissionMap& map,
                   MissionStatistics& statistics) {
  const Trajectory& path = map.path();
  statistics.distance_travelled_m = distance_travelled_m(path, kTravelStepM);
  if (statistics.last) statistics.distance_travelled_m = statistics.last->distance_travelled_m;
  for (const TimedPose& pose : path) {
    statistics.distance_from_start_m =
        (pose.pose.translation() - path.front().pose.translation()).norm();
    statistics.farthest_m = std::max(statistics.farthest_m, statistics.distance_from_start_m);
  }
  if (records.map.truth().empty() || path.empty()) return;
  try {
    statistics.score = score_trajectory(path, records.map.truth());
  } catch (const std::runtime_error&) {  // no time in common
  }
}

/// What turned the robot round, as the mission says it, or else exploration.
void add_homeward(const MissionRecords& records, MissionStatistics& statistics) {
  statistics.homeward_utime = records.phases.homeward_utime();
  if (statistics.last) {
    statistics.return_home_reason = statistics.last->return_home_reason;
  } else {
    statistics.homeward_utime = records.state.homeward_utime();
    statistics.return_home_reason = records.state.homeward_reason();
  }
}

void count_frontiers(const MissionRecords& records, MissionStatistics& statistics) {
  const auto& report = records.state.exploration();
  if (!report) return;
  FrontierCounts counts;
  for (const Frontier& frontier : report->frontiers) {
    ++counts.found;
    ++(is_closed(frontier.state) ? counts.closed : counts.open);
    if (frontier.state == FrontierState::kBlocked) ++counts.blocked;
    if (frontier.state == FrontierState::kUnconfirmed) ++counts.unconfirmed;
  }
  statistics.frontiers = counts;
  statistics.explored_m = report->budget.explored_m;
}

void count_events(const MissionRecords& records, MissionStatistics& statistics) {
  for (const MissionEvent& event : records.events.events()) {
    if (event.kind == MissionEvent::Kind::kRestart) ++statistics.restarts;
    if (event.kind != MissionEvent::Kind::kStop) continue;
    ++statistics.stops;
    statistics.stopped_s += event.seconds();
  }
}

void count_scans(const MissionRecords& records, MissionStatistics& statistics) {
  statistics.scans = records.scans.scans().size();
  for (const RecordedScan& scan : records.scans.scans()) {
    const bool found =
        std::any_of(scan.plans.begin(), scan.plans.end(),
                    [](const RecordedPlan& plan) { return plan.outcome == PlanOutcome::kFound; });
    if (!scan.plans.empty() && !found) ++statistics.scans_without_path;
  }
}

}  // namespace

MissionStatistics mission_statistics(const MissionRecords& records, const MissionMap& map) {
  MissionStatistics statistics;
  statistics.simulated = records.log_info.simulated();
  statistics.from_utime = records.log_info.first_utime;
  statistics.to_utime = records.log_info.last_utime;
  statistics.phases = phase_shares(records.phases.intervals());
  statistics.last = records.phases.last();
  add_homeward(records, statistics);
  add_distances(records, map, statistics);
  count_scans(records, statistics);
  statistics.local_maps = map.full_map().local_maps.size();
  statistics.loop_closures = count_loop_closures(map.full_map());
  statistics.revoked = graph_picture(map.full_map()).revoked.size();
  count_frontiers(records, statistics);
  count_events(records, statistics);
  if (records.state.run_state()) statistics.failure = records.state.run_state()->failure;
  for (const auto& [stage, copy] : records.log_info.configs) statistics.version = copy.version;
  return statistics;
}

const char* name_of(Phase phase) {
  switch (phase) {
    case Phase::kWaiting:
      return "wait";
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

const char* name_of(MissionOutcome outcome) {
  switch (outcome) {
    case MissionOutcome::kInProgress:
      return "under way";
    case MissionOutcome::kHome:
      return "home";
    case MissionOutcome::kStopped:
      return "stopped";
    case MissionOutcome::kStranded:
      return "stranded";
  }
  return "";
}

namespace {

std::string is_or_are(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " is" : " are");
}

/// Of the openings that nobody saw behind.
std::string uncertain_frontiers_text(const FrontierCounts& frontiers) {
  std::string text;
  const auto add = [&](std::size_t count, const char* description) {
    if (count > 0) text += (text.empty() ? "" : ", ") + is_or_are(count) + description;
  };
  add(frontiers.open - frontiers.unconfirmed, " left open");
  add(frontiers.unconfirmed, " given up, though nobody saw what blocks the way");
  add(frontiers.blocked, " blocked");
  return text;
}

std::string frontiers_text(const MissionStatistics& statistics) {
  if (!statistics.frontiers || statistics.frontiers->found == 0) return "";
  const bool complete = statistics.last && statistics.last->complete;
  const std::string found = count_text(statistics.frontiers->found, "opening");
  const std::string uncertain = uncertain_frontiers_text(*statistics.frontiers);
  if (!complete)
    return " Of " + found + ", " + (uncertain.empty() ? "all are closed" : uncertain) + ".";
  return " It explored the mine: every one of the " + found +
         " that it saw is closed, with evidence" +
         (uncertain.empty() ? "." : "; " + uncertain + ".");
}

std::string end_text(const MissionStatistics& statistics) {
  const std::string away = metres(statistics.distance_from_start_m) + " from where it started";
  if (!statistics.last) {
    return "The log does not say how the mission stood (it has no PHASE); the robot was " + away +
           " when it ended.";
  }
  switch (statistics.last->outcome) {
    case MissionOutcome::kHome:
      return "The robot came home.";
    case MissionOutcome::kStopped:
      return "The mission was stopped by order; the robot stands " + away + ".";
    case MissionOutcome::kStranded:
      return "The robot did not come home: it stands " + away + ", and no way was found any more.";
    case MissionOutcome::kInProgress:
      return std::string("The log ends while the mission is under way (") +
             name_of(statistics.last->phase) + "); the robot was " + away + ".";
  }
  return "";
}

}  // namespace

std::string outcome_text(const MissionStatistics& statistics) {
  std::string text = end_text(statistics) + frontiers_text(statistics);
  if (statistics.failure && !statistics.failure->empty()) {
    text += " The simulated run failed: " + sentence(*statistics.failure);
  }
  return text;
}

}  // namespace adit
