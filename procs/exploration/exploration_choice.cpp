// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Where to go: to which stub, home, or on patrol, and along which way.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "procs/exploration/choice/frontier_choice.hpp"
#include "procs/exploration/choice/route_point.hpp"
#include "procs/exploration/exploration.hpp"

namespace adit {
namespace {

/// Each place of a line as the mean of itself and `reach` neighbours to each side, of fewer near
/// the ends, which stay where they are.
inline std::vector<Eigen::Vector2d> moving_average(const std::vector<Eigen::Vector2d>& line,
                                                   int reach) {
  const int n = static_cast<int>(line.size());
  std::vector<Eigen::Vector2d> smooth;
  for (int i = 0; i < n; ++i) {
    const int near = std::min({reach, i, n - 1 - i});
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (int k = i - near; k <= i + near; ++k) sum += line[static_cast<std::size_t>(k)];
    smooth.emplace_back(sum / (2 * near + 1));
  }
  return smooth;
}

constexpr int kSmoothedWith = 3;        // neighbours to each side, against the steps of cells
constexpr double kAlongRad = 0.6;       // between the way to a stub and the way on from there
constexpr double kStraightOnRad = 1.0;  // that a corridor may bend, in the mode corridor
constexpr double kStraightOnM = 30.0;   // how far ahead its open end may be
constexpr double kAtFrontierM = 1.5;    // too near to a stub for a direction
constexpr double kHomeAheadM = 12.0;    // the next goal, and not a place on the way there
constexpr double kNoPathM = 1e6;

std::string metres(double metres) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.0f m", metres);
  return text;
}

double heading_of(const Eigen::Vector2d& direction) {
  return std::atan2(direction.y(), direction.x());
}

double angle_between(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::abs(angle_diff(heading_of(a), heading_of(b)));
}

}  // namespace

std::optional<int> Exploration::choose(const ExplorationState& state,
                                       const std::vector<FrontierCandidate>& candidates) const {
  if (params_.mode == "corridor") return straight_on(state, candidates);
  if (params_.choice.rule != "tour") {
    return choose_by_rule(params_.choice.rule, candidates, register_.frontiers(), state.T_map_body,
                          decision_.frontier);
  }
  const Frontier* target = register_.find(decision_.frontier);
  const auto target_id = target == nullptr ? std::nullopt : std::optional(target->id);
  const auto near = nearest_candidates(candidates, target_id, params_.choice);
  return choose_frontier(near, path_lengths_between(near), target_id, params_.choice);
}

/// Ways between all of these stubs [m].
Eigen::MatrixXd Exploration::path_lengths_between(
    const std::vector<FrontierCandidate>& candidates) const {
  const auto n = static_cast<Eigen::Index>(candidates.size());
  Eigen::MatrixXd path_lengths = Eigen::MatrixXd::Zero(n, n);
  if (n < 2) return path_lengths;
  std::vector<Eigen::Vector2d> places;
  for (const FrontierCandidate& candidate : candidates)
    places.push_back(register_.find(candidate.frontier)->p_map);
  for (Eigen::Index i = 0; i + 1 < n; ++i) {
    const std::vector<Eigen::Vector2d> others(places.begin() + i + 1, places.end());
    const ShortestPathTree field(space_, places[static_cast<std::size_t>(i)],
                                 PathPreference::kAnyDrivable, others);
    for (Eigen::Index j = i + 1; j < n; ++j) {
      const auto leg = field.distance_m(places[static_cast<std::size_t>(j)]);
      path_lengths(i, j) = path_lengths(j, i) = leg.value_or(kNoPathM);
    }
  }
  return path_lengths;
}

/// The open end that lies ahead most nearly straight (paper, section 3.3).
std::optional<int> Exploration::straight_on(
    const ExplorationState& state, const std::vector<FrontierCandidate>& candidates) const {
  const Eigen::Vector2d ahead(std::cos(state.T_map_body.theta), std::sin(state.T_map_body.theta));
  std::optional<int> best;
  double least = kStraightOnRad;
  for (const FrontierCandidate& candidate : candidates) {
    const Eigen::Vector2d leg =
        register_.find(candidate.frontier)->p_map - state.T_map_body.translation();
    const double off = candidate.path_length_m < 1.0 ? 0.0 : angle_between(leg, ahead);
    if (candidate.path_length_m > kStraightOnM || off >= least) continue;
    least = off;
    best = candidate.frontier;
  }
  return best;
}

/// Of the open stubs those within the budget; the others are marked as beyond it.
std::vector<FrontierCandidate> Exploration::candidates(const ExplorationState& state,
                                                       const ShortestPathTree& here) {
  const double mean_m = mean_corridor_m(corridors_, params_.gain);
  std::vector<FrontierCandidate> candidates;
  for (std::size_t i = 0; i < register_.frontiers().size(); ++i) {
    const Frontier& frontier = register_.frontiers()[i];
    if (!is_visitable(frontier.state)) continue;
    const auto leg = here.distance_m(frontier.p_map);
    const auto home = from_home_->distance_m(frontier.p_map);
    if (!leg || !home) continue;
    const FrontierCandidate candidate{
        frontier.id, expected_gain_m(frontier, space_, mean_m, state.sd_m, params_.gain), *leg,
        *home};
    const bool within =
        is_within_budget(candidate, params_.step_m, state.remaining_m, params_.choice);
    register_.set_within_budget(frontier.id, within,
                                "it is " + metres(*leg) + " away and " + metres(*home) +
                                    " from home, of " + metres(state.remaining_m) +
                                    " that are left",
                                state.utime);
    if (within) candidates.push_back(candidate);
  }
  return candidates;
}

ExplorationDecision Exploration::to_frontier(int id, const ExplorationState& state,
                                             const ShortestPathTree& here) {
  const Frontier& frontier = *register_.find(id);
  route_ = here.path_from(frontier.p_map);
  std::reverse(route_.begin(), route_.end());
  ExplorationDecision decision;
  decision.frontier = id;
  decision.distance_m = here.distance_m(frontier.p_map).value_or(0.0);
  const Eigen::Vector2d leg = frontier.p_map - state.T_map_body.translation();
  const bool straight = decision.distance_m < kAtFrontierM ||
                        (decision.distance_m < 1.1 * leg.norm() &&
                         angle_between(leg, frontier.direction_map) < kAlongRad);
  if (decision.distance_m <= params_.step_m && straight) {
    decision.kind = ExplorationDecision::Kind::kAlong;
    decision.T_map_goal = {frontier.p_map.x(), frontier.p_map.y(),
                           heading_of(frontier.direction_map)};
    decision.reason = "straight on to stub " + std::to_string(id);
    return decision;
  }
  const RoutePoint place = point_along(route_, params_.step_m);
  decision.kind = ExplorationDecision::Kind::kGoTo;
  decision.T_map_goal = {place.p_map.x(), place.p_map.y(), heading_of(place.direction)};
  decision.reason =
      "to stub " + std::to_string(id) + ", " + metres(decision.distance_m) + " from here";
  return decision;
}

ExplorationDecision Exploration::to_home(const ExplorationState& state, std::string reason) {
  ExplorationDecision decision;
  const Pose2 home = T_map_home();
  route_ = from_home_->path_from(state.T_map_body.translation());
  decision.distance_m = from_home_->distance_m(state.T_map_body.translation()).value_or(0.0);
  decision.complete = incomplete_reasons().empty();
  decision.reason = std::move(reason);
  if ((state.T_map_body.translation() - home.translation()).norm() <= params_.at_home_m) {
    decision.kind = ExplorationDecision::Kind::kDone;
    decision.T_map_goal = state.T_map_body;
    return decision;
  }
  decision.kind = ExplorationDecision::Kind::kHome;
  if (decision.distance_m <= kHomeAheadM) {
    decision.T_map_goal = home;
    return decision;
  }
  const RoutePoint place = point_along(route_, params_.step_m);
  decision.T_map_goal = {place.p_map.x(), place.p_map.y(), heading_of(place.direction)};
  return decision;
}

std::vector<PatrolPlace> Exploration::places() const {
  std::vector<PatrolPlace> places;
  for (int id = 0; params_.patrol && id <= known_.newest().value_or(-1); ++id) {
    if (const auto T_map_local = known_.pose_of(id)) {
      places.push_back({id, T_map_local->translation()});
    }
  }
  return places;
}

/// Where nothing is left to be explored; nothing where no place is within the budget any more.
std::optional<ExplorationDecision> Exploration::to_next_patrol_place(const ExplorationState& state,
                                                                     const ShortestPathTree& here) {
  std::vector<PatrolPlace> within = places();
  std::erase_if(within, [&](const PatrolPlace& place) {
    const auto leg = here.distance_m(place.p_map);
    const auto home = from_home_->distance_m(place.p_map);
    return !leg || !home ||
           !is_within_budget({-1, 0.0, *leg, *home}, 0.0, state.remaining_m, params_.choice);
  });
  patrol_target_ = patrol_.next(within);
  if (!patrol_target_) return std::nullopt;
  route_ = here.path_from(patrol_target_->p_map);
  std::reverse(route_.begin(), route_.end());
  ExplorationDecision decision;
  decision.kind = ExplorationDecision::Kind::kGoTo;
  decision.distance_m = here.distance_m(patrol_target_->p_map).value_or(0.0);
  decision.complete = incomplete_reasons().empty();
  const RoutePoint place = point_along(route_, params_.step_m);
  decision.T_map_goal = {place.p_map.x(), place.p_map.y(), heading_of(place.direction)};
  decision.reason = "on patrol to where local map " + std::to_string(patrol_target_->local_map) +
                    " began, " + metres(decision.distance_m) + " from here, seen longest ago";
  return decision;
}

/// Not where the way on from a stub would come back to the robot: who follows it as far as it can
/// would get to its end without ever having gone to the stub.
bool Exploration::leads_on(const Frontier& frontier) const {
  const Eigen::Vector2d leg = frontier.p_map - state_.T_map_body.translation();
  return leg.norm() < kAtFrontierM || leg.dot(frontier.direction_map) >= 0.0;
}

std::vector<Eigen::Vector2d> Exploration::path_ahead(double length_m, double spacing_m) const {
  using Kind = ExplorationDecision::Kind;
  if (decision_.kind == Kind::kStay || decision_.kind == Kind::kDone) return {};
  std::vector<Eigen::Vector2d> line{state_.T_map_body.translation()};
  line.insert(line.end(), route_.begin(), route_.end());
  const Frontier* frontier = register_.find(decision_.frontier);
  if (frontier != nullptr) {
    line.push_back(frontier->p_map);
    if (leads_on(*frontier))
      line.emplace_back(frontier->p_map + length_m * frontier->direction_map);
  } else {
    line.push_back(patrol_target_ ? patrol_target_->p_map : T_map_home().translation());
  }
  return moving_average(resampled(line, length_m, spacing_m), kSmoothedWith);
}

}  // namespace adit
