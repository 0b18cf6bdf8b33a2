// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/mission_statistics.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>

#include <fmt/format.h>

#include "tools/map/map_files.hpp"
#include "tools/report/text_format.hpp"

namespace adit {
namespace {

std::vector<PhaseShare> phase_shares(const std::vector<PhaseInterval>& intervals) {
  std::map<Phase, PhaseShare> shares;
  double all_s = 0.0;
  for (const PhaseInterval& interval : intervals) {
    PhaseShare& share = shares[interval.phase.phase];
    share.phase = interval.phase.phase;
    ++share.times;
    share.duration_s += interval.duration_s();
    all_s += interval.duration_s();
  }
  std::vector<PhaseShare> found;
  for (auto& [phase, share] : shares) {
    share.share = all_s > 0.0 ? share.duration_s / all_s : 0.0;
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
  } catch (const std::runtime_error&) {  // no common times: no score
  }
}

void add_consistency(const MissionRecords& records, const MissionMap& map,
                     MissionStatistics& statistics) {
  std::map<int, std::int64_t> utimes;
  for (const LocalMap* local : map.full_map().local_maps) utimes[local->id] = local->utime;
  statistics.consistency = score_consistency(map.full_map().graph, utimes, records.map.truth());
}

/// Time and reason of the return, from PHASE, otherwise from EXPLORATION.
void add_return_home(const MissionRecords& records, MissionStatistics& statistics) {
  statistics.return_home_utime = records.phases.return_home_utime();
  if (statistics.last) {
    statistics.return_home_reason = statistics.last->return_home_reason;
  } else {
    statistics.return_home_utime = records.state.return_home_utime();
    statistics.return_home_reason = records.state.return_home_reason();
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
    if (is_visitable(frontier.state)) ++counts.visitable;
  }
  statistics.frontiers = counts;
  statistics.explored_m = report->budget.explored_m;
}

void add_contradictions(const MissionRecords& records, const MissionMap& map,
                        MissionStatistics& statistics) {
  statistics.contradictory = contradictory_stretches(
      records.map.contradictions(), DistanceAlong(map.path()), map.full_map().local_maps);
}

void count_events(const MissionRecords& records, MissionStatistics& statistics) {
  for (const MissionEvent& event : records.events.events()) {
    if (event.kind == MissionEvent::Kind::kRestart) ++statistics.restarts;
    if (event.kind != MissionEvent::Kind::kStop) continue;
    ++statistics.stops;
    statistics.stopped_s += event.duration_s();
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
  statistics.budget = records.phases.budget();
  statistics.last = records.phases.last();
  add_return_home(records, statistics);
  add_distances(records, map, statistics);
  add_consistency(records, map, statistics);
  count_scans(records, statistics);
  statistics.local_maps = map.full_map().local_maps.size();
  statistics.loop_closures = count_loop_closures(map.full_map());
  statistics.revoked = graph_picture(map.full_map()).revoked.size();
  add_contradictions(records, map, statistics);
  count_frontiers(records, statistics);
  count_events(records, statistics);
  if (records.state.run_state()) statistics.failure = records.state.run_state()->failure;
  for (const auto& [stage, config] : records.log_info.configs) {
    statistics.version = config.version;
  }
  return statistics;
}

namespace {

/// "3 of 7 frontiers are closed (2 blocked), 3 open".
std::string counts_text(const FrontierCounts& frontiers) {
  std::string text =
      fmt::format("{} of {} are closed", frontiers.closed, count_text(frontiers.found, "frontier"));
  if (frontiers.blocked > 0) text += fmt::format(" ({} blocked)", frontiers.blocked);
  const std::size_t open = frontiers.open - frontiers.unconfirmed;
  if (open > 0) text += fmt::format(", {} open", open);
  if (frontiers.unconfirmed > 0) {
    text += fmt::format(", {} abandoned without evidence of a blockage", frontiers.unconfirmed);
  }
  return text;
}

std::string frontiers_text(const MissionStatistics& statistics) {
  if (!statistics.frontiers || statistics.frontiers->found == 0) return "";
  const bool complete = statistics.last && statistics.last->complete;
  return fmt::format(" The exploration is {}: {}.", complete ? "complete" : "incomplete",
                     counts_text(*statistics.frontiers));
}

/// ", within 0.21 m (95 %)"; empty if unknown.
std::string within_text(const char* before, const MissionPhase& phase) {
  if (!phase.home_within_m) return "";
  return fmt::format("{}{:.2f} m (95 %)", before, *phase.home_within_m);
}

std::string end_text(const MissionStatistics& statistics) {
  const std::string distance =
      fmt::format("{} from the start", metres(statistics.distance_from_start_m));
  if (!statistics.last) {
    return fmt::format("The outcome is unknown: the log has no PHASE. At its end the robot was {}.",
                       distance);
  }
  switch (statistics.last->outcome) {
    case MissionOutcome::kHome:
      if (never_left_start(*statistics.last))
        return "The robot did not leave the start: " + statistics.last->reason;
      return fmt::format("The robot returned home{}.", within_text(", within ", *statistics.last));
    case MissionOutcome::kHomeUncertain:
      if (!statistics.last->home_within_m) return "The robot does not know where home is.";
      return fmt::format("The robot is at home by its own estimate, but not sure{}.",
                         within_text(": within ", *statistics.last));
    case MissionOutcome::kStopped:
      return fmt::format("The mission was stopped by order; the robot is {}.", distance);
    case MissionOutcome::kStranded:
      return fmt::format("The robot did not return home: it is stranded {}, without a path.",
                         distance);
    case MissionOutcome::kInProgress:
      return fmt::format("The log ends while the mission is in progress ({}); the robot was {}.",
                         name_of(statistics.last->phase), distance);
  }
  return "";
}

/// Where the map contradicts itself; empty if it does not.
std::string map_quality_text(const MissionStatistics& statistics) {
  if (statistics.contradictory.empty()) return "";
  double length_m = 0.0;
  for (const DoubtfulStretch& stretch : statistics.contradictory) {
    length_m += stretch.to_m - stretch.from_m;
  }
  return fmt::format(" The map contradicts itself over {}: {}.", metres(length_m),
                     stretches_text(statistics.contradictory));
}

}  // namespace

std::string outcome_text(const MissionStatistics& statistics) {
  std::string text =
      end_text(statistics) + frontiers_text(statistics) + map_quality_text(statistics);
  if (statistics.failure && !statistics.failure->empty()) {
    text += fmt::format(" The simulated run failed: {}", sentence(*statistics.failure));
  }
  return text;
}

std::string time_text(const TimeBudget& budget) {
  constexpr double kShareMin = 0.01;
  const double all_s = budget.duration_s();
  std::string text;
  for (std::size_t i = 0; i < kActivities; ++i) {
    const auto activity = static_cast<Activity>(i);
    const double share = all_s > 0.0 ? budget.share(activity).duration_s / all_s : 0.0;
    if (share < kShareMin) continue;
    text += fmt::format("{}{:.0f} % {}", text.empty() ? "" : ", ", 100.0 * share,
                        description_of(activity));
  }
  return text;
}

std::string accuracy_text(const MissionStatistics& statistics) {
  if (!statistics.score) return "";
  const TrajectoryScore& score = *statistics.score;
  std::string text = fmt::format("RMSE from the start: {:.3f} m in plan ({:.1f} of the allowed)",
                                 score.anchored.rmse_m, score.plan_of_allowed);
  if (score.heights) {
    text += fmt::format(", {:.3f} m in height ({:.1f})", score.anchored.z.rmse_m,
                        score.height_of_allowed);
  }
  if (!statistics.consistency) return text;
  const MapConsistency& consistency = *statistics.consistency;
  return text + fmt::format("; {} of {} local maps in their 95 % ellipsoid",
                            consistency.in_ellipsoid, consistency.local_maps);
}

}  // namespace adit
