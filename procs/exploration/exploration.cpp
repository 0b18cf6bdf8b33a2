// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/exploration.hpp"

#include <algorithm>
#include <utility>

#include "procs/exploration/skeleton.hpp"

namespace adit {
namespace {

std::string why_not_closed(const Stub& stub) {
  if (stub.state == StubState::kBeyondBudget) return " is beyond the budget: " + stub.evidence;
  if (is_to_visit(stub.state)) return " is open";
  return " was given up, but nobody saw that it is blocked: " + stub.evidence;
}

}  // namespace

Exploration::Exploration(const ExplorationParams& params)
    : params_(params), known_(params.known), register_(params.stubs) {}

bool Exploration::add(const LocalMap& map) {
  if (map.id < 0) return false;
  auto tile = known_tile(map, params_.lasers, params_.known.tiles);
  if (!tile) return false;
  known_.add(map.id, std::move(*tile));
  utime_ = std::max(utime_, map.end_utime);
  return true;
}

bool Exploration::update(const MapGraph& graph) {
  const bool sound = std::all_of(graph.poses.begin(), graph.poses.end(),
                                 [](const Pose2& pose) { return pose.vector().allFinite(); });
  if (!sound) return false;
  known_.pose(graph.poses);
  revision_ = graph.revision;
  utime_ = std::max(utime_, graph.utime);
  if (!known_.newest()) return true;
  add_way_out();
  refresh();
  return true;
}

/// Everything that follows from the known space.
void Exploration::refresh() {
  space_ = drivable_space(known_.cells(), known_.resolution_m(), params_.vehicle.width_m, cuts(),
                          T_map_home().translation(), params_.drivable);
  ends_ = open_ends(space_, params_.stubs.join_m);
  for (OpenEnd& end : ends_) {
    if (leads_out(end)) end.access = Access::kBehindBarrier;
  }
  register_.update(ends_, known_, barrier_texts(), utime_);
  corridors_ = corridor_graph(space_, skeleton(space_), ends_, params_.corridors);
  from_home_.emplace(space_, T_map_home().translation(), Trust::kDriven);
}

/// The start is where the first local map began.
Pose2 Exploration::T_map_home() const { return known_.pose_of(0).value_or(Pose2{}); }

/// With each new local map.
void Exploration::note_pursuit(const ExplorationState& state, const TravelField& here) {
  const int newest = known_.newest().value_or(-1);
  const Stub* target = register_.find(decision_.stub);
  if (newest == newest_seen_ || target == nullptr) return;
  newest_seen_ = newest;
  const auto way = here.distance_m(target->p_map);
  if (way) register_.pursued(target->id, *way, newest, state.utime);
}

const ExplorationDecision& Exploration::decide(const ExplorationState& state) {
  state_ = state;
  const int before = decision_.stub;
  decision_ = make(state);
  if (decision_.stub != before) register_.begin_pursuit(decision_.stub);
  return decision_;
}

ExplorationDecision Exploration::make(const ExplorationState& state) {
  route_.clear();
  patrolled_.reset();
  ExplorationDecision stay;
  stay.T_map_goal = state.T_map_body;
  if (!from_home_) {
    stay.reason = "there is no map yet";
    return stay;
  }
  if (is_cut_off(state)) drop_passed_barriers(state);
  if (is_cut_off(state)) {
    stay.reason = "no known way leads from here to the start";
    return stay;
  }
  const TravelField here(space_, state.T_map_body.translation(), Trust::kSeen);
  patrol_.pass(places(), state.T_map_body.translation(), state.utime);
  note_pursuit(state, here);
  const auto all = offers(state, here);
  if (state.homeward) return to_home(state, "the mission has turned around");
  if (returning_) return to_home(state, "the corridor is explored as far as it goes");
  if (const auto stub = choose(state, all)) return to_stub(*stub, state, here);
  if (retry_given_up(state.utime)) return make(state);
  if (const auto on = to_longest_ago(state, here)) return *on;
  returning_ = params_.mode == "corridor";
  const auto why = reasons_why_not_complete();
  return to_home(state, why.empty() ? "every stub is closed" : why.front());
}

std::vector<std::string> Exploration::reasons_why_not_complete() const {
  std::vector<std::string> reasons;
  for (const Stub& stub : register_.stubs()) {
    if (is_closed(stub.state)) continue;
    const std::string name = "stub " + std::to_string(stub.id);
    reasons.push_back(name + why_not_closed(stub));
  }
  return reasons;
}

ExplorationMemory Exploration::memory() const {
  return {register_.remembered(), barriers_,    decision_.kind,
          decision_.stub,         newest_seen_, returning_};
}

void Exploration::restore(const ExplorationMemory& memory) {
  register_.restore(memory.stubs);
  barriers_ = memory.barriers;
  decision_ = {};
  decision_.kind = memory.kind;
  decision_.stub = memory.target;
  newest_seen_ = memory.newest_seen;
  returning_ = memory.returning;
}

ExplorationReport Exploration::report() const {
  ExplorationReport report;
  report.utime = std::max(utime_, state_.utime);
  report.revision = revision_;
  report.decision = decision_;
  report.budget.remaining_m = state_.remaining_m;
  if (from_home_) {
    report.budget.home_m = from_home_->distance_m(state_.T_map_body.translation()).value_or(0.0);
  }
  report.budget.explored_m = corridors_.length_m();
  report.stubs = register_.stubs();
  report.corridors = corridors_;
  return report;
}

}  // namespace adit
