// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/exploration.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "procs/exploration/map/skeleton_graph.hpp"

namespace adit {
namespace {

std::string incomplete_reason(const Frontier& frontier) {
  const std::string name = fmt::format("frontier {}", frontier.id);
  if (frontier.state == FrontierState::kBeyondBudget)
    return fmt::format("{} is beyond the budget: {}", name, frontier.evidence);
  if (is_visitable(frontier.state)) return name + " is open";
  return fmt::format("{} was abandoned without evidence that it is blocked: {}", name,
                     frontier.evidence);
}

}  // namespace

Exploration::Exploration(const ExplorationParams& params)
    : params_(params), known_(params.known), register_(params.frontiers, params.vehicle.width_m) {}

bool Exploration::add(const LocalMap& map) {
  if (map.id < 0) return false;
  auto tile = make_local_map_tile(map, params_.lasers, params_.known.tiles);
  if (!tile) return false;
  known_.add(map.id, std::move(*tile));
  utime_ = std::max(utime_, map.end_utime);
  return true;
}

const ScannedGround* Exploration::add(const TerrainMap& terrain, const Pose2& T_map_level,
                                      std::optional<double> z_m) {
  const int layer = known_.layer_at(T_map_level.translation(), z_m);
  const Eigen::Vector2d p = known_.atlas().to_atlas(T_map_level.translation(), layer);
  const Pose2 T_atlas_level{p.x(), p.y(), T_map_level.theta};
  auto anchor = known_.tile_at(p);
  if (!anchor) anchor = known_.newest();
  if (!anchor) return nullptr;
  known_.add({anchor->id, between(anchor->T_map_local, T_atlas_level),
              scanned_cells(terrain, known_.resolution_m(), params_.vehicle)});
  refresh();
  return &known_.scanned_ground().back();
}

bool Exploration::update(const MapGraph& graph) {
  const bool valid = std::all_of(graph.poses.begin(), graph.poses.end(),
                                 [](const Pose2& pose) { return pose.vector().allFinite(); });
  if (!valid) return false;
  known_.pose(graph.poses, graph.z_m, graph.z_variance);
  revision_ = graph.revision;
  utime_ = std::max(utime_, graph.utime);
  if (!known_.newest()) return true;
  add_exit_barrier();
  refresh();
  return true;
}

Walls Exploration::walls() const { return verify_walls_ ? Walls::kConfirmed : Walls::kAll; }

/// Recomputes where the vehicle can drive, and the paths home.
void Exploration::refresh_space() {
  space_ = drivable_space(known_.cells(walls()), known_.low_obstacles(), known_.resolution_m(),
                          params_.vehicle.width_m, barrier_lines(), T_map_home().translation(),
                          params_.drivable, known_.shared_cells());
  from_home_.emplace(space_, T_map_home().translation(), PathPreference::kDriven);
}

/// Recomputes everything that is derived from the known space.
void Exploration::refresh() {
  is_outside_ = false;
  refresh_space();
  detected_frontiers_ = detect_frontiers(space_, params_.frontiers.cluster_distance_m);
  for (DetectedFrontier& detected : detected_frontiers_) {
    detected.p_map = known_.in_own_layer(detected.p_map);
    if (leads_out(detected)) detected.access = Access::kBehindBarrier;
    detected.at_dismissed_wall = known_.dismisses_wall_near(detected.p_map, walls());
  }
  register_.update(detected_frontiers_, known_, barrier_evidence(), utime_);
  corridors_ = corridor_graph(space_, skeleton(space_), detected_frontiers_, params_.corridors);
  for (CorridorNode& node : corridors_.nodes) node.p_map = known_.atlas().to_map(node.p_map);
  for (Corridor& corridor : corridors_.corridors) {
    corridor.points = in_map(std::move(corridor.points));
  }
}

/// The start: the pose of the first local map, which is the origin of map as long as the graph has
/// no other pose for it.
Pose2 Exploration::T_map_home() const { return known_.pose_of(0).value_or(Pose2{}); }

/// Records once per new local map how far the target still is.
void Exploration::update_pursuit(const ExplorationState& state, const ShortestPathTree& here) {
  const std::optional<PosedTile> newest = known_.newest();
  const Frontier* target = register_.find(decision_.frontier);
  if (!newest || newest->id == pursuit_local_map_ || target == nullptr) return;
  pursuit_local_map_ = newest->id;
  const auto path_length_m = here.distance_m(target->p_map);
  if (path_length_m) register_.record_pursuit(target->id, *path_length_m, newest->id, state.utime);
}

const ExplorationDecision& Exploration::decide(const ExplorationState& state) {
  state_ = state;
  const int previous_target = decision_.frontier;
  decision_ = make_decision(state);
  if (decision_.frontier != previous_target) register_.begin_pursuit(decision_.frontier);
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
  set_outside(false);
  if (!path_length_home_m(state)) drop_passed_barriers(state);
  const std::optional<double> home_m = path_length_home_m(state);
  if (!home_m) {
    stay.reason = "no known path leads from here to the start";
    return stay;
  }
  const ShortestPathTree here(space_, p_atlas_body(state), PathPreference::kAnyDrivable);
  patrol_.pass(patrol_places(), p_atlas_body(state), state.utime);
  update_pursuit(state, here);
  const auto within_budget = candidates(state, here);
  if (state.returning_home) {
    // Complete is claimed of a mission that turned around, too.
    if (incomplete_reasons().empty() && verify_walls()) return make_decision(state);
    return to_home(state, *home_m, "the mission returns home");
  }
  if (returning_) return to_home(state, *home_m, "the corridor is explored to its end");
  if (const auto target = choose(state, within_budget)) return to_frontier(*target, state, here);
  if (retry_abandoned(state.utime) || verify_walls()) return make_decision(state);
  if (const auto patrol = to_next_patrol_place(state, here)) return *patrol;
  returning_ = params_.mode == "corridor";
  const auto reasons = incomplete_reasons();
  return to_home(state, *home_m, reasons.empty() ? "every frontier is closed" : reasons.front());
}

/// A level laser sees rising ground and falling roof as a wall: before the mine counts as explored,
/// each wall at the rim must have been seen by a 3D scan. Returns true when this begins.
bool Exploration::verify_walls() {
  if (verify_walls_ || known_.scanned_ground().empty()) return false;
  verify_walls_ = true;
  register_.forget_closings();
  refresh();
  return true;
}

std::vector<std::string> Exploration::incomplete_reasons() const {
  std::vector<std::string> reasons;
  for (const Frontier& frontier : register_.frontiers()) {
    if (is_closed(frontier.state)) continue;
    reasons.push_back(incomplete_reason(frontier));
  }
  return reasons;
}

ExplorationMemory Exploration::memory() const {
  return {register_.stored_frontiers(), barriers_,  decision_.kind, decision_.frontier,
          pursuit_local_map_,           returning_, verify_walls_};
}

void Exploration::restore(const ExplorationMemory& memory) {
  register_.restore(memory.frontiers);
  barriers_ = memory.barriers;
  decision_ = {};
  decision_.kind = memory.kind;
  decision_.frontier = memory.target;
  pursuit_local_map_ = memory.pursuit_local_map;
  returning_ = memory.returning;
  verify_walls_ = memory.verify_walls;
}

void Exploration::restore(std::vector<ScannedGround> grounds) {
  known_.clear_scanned_ground();
  for (ScannedGround& ground : grounds) known_.add(std::move(ground));
}

ExplorationReport Exploration::report() const {
  ExplorationReport report;
  report.utime = std::max(utime_, state_.utime);
  report.revision = revision_;
  report.decision = decision_;
  report.budget.remaining_m = state_.remaining_m;
  report.budget.explored_m = corridors_.length_m();
  report.frontiers = frontiers();
  report.corridors = corridors_;
  return report;
}

Eigen::Vector2d Exploration::p_atlas_body(const ExplorationState& state) const {
  const Eigen::Vector2d p_map = state.T_map_body.translation();
  return known_.atlas().to_atlas(p_map, known_.layer_at(p_map, state.z_m));
}

Frontier Exploration::in_map(Frontier frontier) const {
  frontier.p_map = known_.atlas().to_map(frontier.p_map);
  return frontier;
}

std::vector<Eigen::Vector2d> Exploration::in_map(std::vector<Eigen::Vector2d> points) const {
  for (Eigen::Vector2d& p : points) p = known_.atlas().to_map(p);
  return points;
}

std::vector<Frontier> Exploration::frontiers() const {
  std::vector<Frontier> frontiers = register_.frontiers();
  for (Frontier& frontier : frontiers) frontier = in_map(std::move(frontier));
  return frontiers;
}

}  // namespace adit
