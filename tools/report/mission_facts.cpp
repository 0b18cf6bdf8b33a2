// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/mission_facts.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include "common/bus/channels.hpp"
#include "tools/map/graph_files.hpp"

namespace adit {
namespace {

std::vector<PhaseShare> shares_of(const std::vector<PhaseStretch>& stretches) {
  std::map<Phase, PhaseShare> shares;
  double all_s = 0.0;
  for (const PhaseStretch& stretch : stretches) {
    PhaseShare& share = shares[stretch.phase.phase];
    share.phase = stretch.phase.phase;
    ++share.times;
    share.seconds += stretch.seconds();
    all_s += stretch.seconds();
  }
  std::vector<PhaseShare> found;
  for (auto& [phase, share] : shares) {
    share.share = all_s > 0.0 ? share.seconds / all_s : 0.0;
    found.push_back(share);
  }
  return found;
}

void take_way(const MissionRecords& records, const MissionMap& map, MissionFacts& facts) {
  const Trajectory& path = map.path();
  facts.way_m = travelled_m(path, kTravelStepM);
  if (facts.last) facts.way_m = facts.last->travelled_m;
  for (const TimedPose& pose : path) {
    facts.from_start_m = (pose.pose.translation() - path.front().pose.translation()).norm();
    facts.farthest_m = std::max(facts.farthest_m, facts.from_start_m);
  }
  if (records.map.truth().empty() || path.empty()) return;
  try {
    facts.score = score_trajectory(path, records.map.truth());
  } catch (const std::runtime_error&) {  // no time in common
  }
}

/// What turned the robot round, as the mission says it, or else exploration.
void take_turn(const MissionRecords& records, MissionFacts& facts) {
  facts.homeward_utime = records.phases.homeward_utime();
  if (facts.last) {
    facts.homeward_reason = facts.last->homeward_reason;
  } else {
    facts.homeward_utime = records.state.home_utime();
    facts.homeward_reason = records.state.home_reason();
  }
}

void take_stubs(const MissionRecords& records, MissionFacts& facts) {
  const auto& report = records.state.exploration();
  if (!report) return;
  StubCounts counts;
  for (const Stub& stub : report->stubs) {
    ++counts.found;
    ++(is_closed(stub.state) ? counts.closed : counts.open);
    if (stub.state == StubState::kBlocked) ++counts.blocked;
    if (stub.state == StubState::kDoubtful) ++counts.doubtful;
  }
  facts.stubs = counts;
  facts.explored_m = report->budget.explored_m;
}

void take_events(const MissionRecords& records, MissionFacts& facts) {
  for (const MissionEvent& event : records.events.events()) {
    if (event.kind == MissionEvent::Kind::kRestart) ++facts.restarts;
    if (event.kind != MissionEvent::Kind::kStop) continue;
    ++facts.stops;
    facts.stopped_s += event.seconds();
  }
}

void take_scans(const MissionRecords& records, MissionFacts& facts) {
  facts.scans = records.scans.scans().size();
  for (const RecordedScan& scan : records.scans.scans()) {
    const bool found =
        std::any_of(scan.plans.begin(), scan.plans.end(),
                    [](const RecordedPlan& plan) { return plan.outcome == PlanOutcome::kFound; });
    if (!scan.plans.empty() && !found) ++facts.scans_without_path;
  }
}

}  // namespace

MissionFacts mission_facts(const MissionRecords& records, const MissionMap& map) {
  MissionFacts facts;
  facts.simulated = records.census.simulated();
  facts.from_utime = records.census.first_utime;
  facts.to_utime = records.census.last_utime;
  facts.phases = shares_of(records.phases.stretches());
  facts.last = records.phases.last();
  take_turn(records, facts);
  take_way(records, map, facts);
  take_scans(records, facts);
  facts.local_maps = map.whole().local_maps.size();
  facts.closures = count_closures(map.whole());
  facts.revoked = graph_picture(map.whole()).revoked.size();
  take_stubs(records, facts);
  take_events(records, facts);
  if (records.state.run()) facts.failure = records.state.run()->failure;
  for (const auto& [stage, copy] : records.census.configs) facts.version = copy.version;
  return facts;
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
    case MissionOutcome::kUnderWay:
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

}  // namespace adit
