// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/exploration.hpp"

#include <algorithm>
#include <utility>

#include "procs/exploration/map/skeleton_graph.hpp"

namespace adit {
namespace {

std::string open_reason(const Frontier& frontier) {
  if (frontier.state == FrontierState::kBeyondBudget)
    return " is beyond the budget: " + frontier.evidence;
  if (is_visitable(frontier.state)) return " is open";
  return " was given up, but nobody saw that it is blocked: " + frontier.evidence;
}

}  // namespace

Exploration::Exploration(const ExplorationParams& params)
    : params_(params), known_(params.known), register_(params.frontiers) {}

bool Exploration::add(const LocalMap& map) {
  if (map.id < 0) return false;
  auto tile = make_local_map_tile(map, params_.lasers, params_.known.tiles);
  if (!tile) return false;
  known_.add(map.id, std::move(*tile));
  utime_ = std::max(utime_, map.end_utime);
  return true;
}

bool Exploration::update(const MapGraph& graph) {
  const bool valid = std::all_of(graph.poses.begin(), graph.poses.end(),
                                 [](const Pose2& pose) { return pose.vector().allFinite(); });
  if (!valid) return false;
  known_.pose(graph.poses);
  revision_ = graph.revision;
  utime_ = std::max(utime_, graph.utime);
  if (!known_.newest()) return true;
  add_exit_barrier();
  refresh();
  return true;
}

/// Everything that follows from the known space.
void Exploration::refresh() {
  space_ = drivable_space(known_.cells(), known_.resolution_m(), params_.vehicle.width_m,
                          barrier_lines(), T_map_home().translation(), params_.drivable);
  detected_frontiers_ = detect_frontiers(space_, params_.frontiers.cluster_distance_m);
  for (DetectedFrontier& end : detected_frontiers_) {
    if (leads_out(end)) end.access = Access::kBehindBarrier;
  }
  register_.update(detected_frontiers_, known_, barrier_evidence(), utime_);
  corridors_ = corridor_graph(space_, skeleton(space_), detected_frontiers_, params_.corridors);
  from_home_.emplace(space_, T_map_home().translation(), PathPreference::kDriven);
}

/// The start is where the first local map began.
Pose2 Exploration::T_map_home() const { return known_.pose_of(0).value_or(Pose2{}); }

/// With each new local map.
void Exploration::update_pursuit(const ExplorationState& state, const ShortestPathTree& here) {
  const int newest = known_.newest().value_or(-1);
  const Frontier* target = register_.find(decision_.frontier);
  if (newest == pursuit_local_map_ || target == nullptr) return;
  pursuit_local_map_ = newest;
  const auto path_length_m = here.distance_m(target->p_map);
  if (path_length_m) register_.record_pursuit(target->id, *path_length_m, newest, state.utime);
}

const ExplorationDecision& Exploration::decide(const ExplorationState& state) {
  state_ = state;
  const int before = decision_.frontier;
  decision_ = make_decision(state);
  if (decision_.frontier != before) register_.begin_pursuit(decision_.frontier);
  return decision_;
}

ExplorationDecision Exploration::make_decision(const ExplorationState& state) {
  route_.clear();
  patrol_target_.reset();
  ExplorationDecision stay;
  stay.T_map_goal = state.T_map_body;
  if (!from_home_) {
    stay.reason = "there is no map yet";
    return stay;
  }
  if (has_no_path_home(state)) drop_passed_barriers(state);
  if (has_no_path_home(state)) {
    stay.reason = "no known way leads from here to the start";
    return stay;
  }
  const ShortestPathTree here(space_, state.T_map_body.translation(), PathPreference::kAnyDrivable);
  patrol_.pass(places(), state.T_map_body.translation(), state.utime);
  update_pursuit(state, here);
  const auto all = candidates(state, here);
  if (state.returning_home) return to_home(state, "the mission has turned around");
  if (returning_) return to_home(state, "the corridor is explored as far as it goes");
  if (const auto frontier = choose(state, all)) return to_frontier(*frontier, state, here);
  if (retry_abandoned(state.utime)) return make_decision(state);
  if (const auto on = to_next_patrol_place(state, here)) return *on;
  returning_ = params_.mode == "corridor";
  const auto why = incomplete_reasons();
  return to_home(state, why.empty() ? "every stub is closed" : why.front());
}

std::vector<std::string> Exploration::incomplete_reasons() const {
  std::vector<std::string> reasons;
  for (const Frontier& frontier : register_.frontiers()) {
    if (is_closed(frontier.state)) continue;
    const std::string name = "stub " + std::to_string(frontier.id);
    reasons.push_back(name + open_reason(frontier));
  }
  return reasons;
}

ExplorationMemory Exploration::memory() const {
  return {register_.stored_frontiers(), barriers_,          decision_.kind,
          decision_.frontier,           pursuit_local_map_, returning_};
}

void Exploration::restore(const ExplorationMemory& memory) {
  register_.restore(memory.frontiers);
  barriers_ = memory.barriers;
  decision_ = {};
  decision_.kind = memory.kind;
  decision_.frontier = memory.target;
  pursuit_local_map_ = memory.pursuit_local_map;
  returning_ = memory.returning;
}

ExplorationReport Exploration::report() const {
  ExplorationReport report;
  report.utime = std::max(utime_, state_.utime);
  report.revision = revision_;
  report.decision = decision_;
  report.budget.remaining_m = state_.remaining_m;
  report.budget.explored_m = corridors_.length_m();
  report.frontiers = register_.frontiers();
  report.corridors = corridors_;
  return report;
}

}  // namespace adit
