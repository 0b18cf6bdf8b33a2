// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Selects the target: a frontier, home or a patrol place, and the route to it.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

#include "procs/exploration/choice/frontier_choice.hpp"
#include "procs/exploration/choice/route_point.hpp"
#include "procs/exploration/exploration.hpp"

namespace adit {
namespace {

/// Moving average over `reach` neighbours to each side of a point, over fewer near the ends; the
/// end points stay where they are.
std::vector<Eigen::Vector2d> moving_average(const std::vector<Eigen::Vector2d>& line, int reach) {
  const int n = static_cast<int>(line.size());
  std::vector<Eigen::Vector2d> smooth;
  for (int i = 0; i < n; ++i) {
    const int half = std::min({reach, i, n - 1 - i});
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (int k = i - half; k <= i + half; ++k) sum += line[static_cast<std::size_t>(k)];
    smooth.emplace_back(sum / (2 * half + 1));
  }
  return smooth;
}

constexpr int kSmoothedWith = 3;  // neighbours to each side; smooths the steps of the cells
constexpr double kAlongRad =
    0.6;  // between the path to a frontier and the direction of the frontier
constexpr double kStraightAheadRad = 1.0;  // bend of a corridor at most, in the mode corridor
constexpr double kStraightAheadM = 30.0;   // distance of the frontier ahead at most
constexpr double kAtFrontierM = 1.5;       // closer to a frontier its bearing is not significant
constexpr double kHomeAheadM =
    12.0;  // within this, home itself is the goal instead of a point on the route
constexpr double kScanRangeM = 12.0;
constexpr double kNoPathM = 1e6;  // cost of a leg without a path: finite, so that sums stay ordered

double heading_of(const Eigen::Vector2d& direction) {
  return std::atan2(direction.y(), direction.x());
}

double angle_between(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::abs(angle_diff(heading_of(a), heading_of(b)));
}

std::string budget_evidence(const FrontierCandidate& candidate, double remaining_m) {
  const double climb_m = candidate.climb_m + candidate.return_climb_m;
  const std::string climb = climb_m > 0.0 ? fmt::format(", with {:.0f} m of climb", climb_m) : "";
  return fmt::format("it is {:.0f} m away and {:.0f} m from home{}, and {:.0f} m remain",
                     candidate.path_length_m, candidate.return_length_m, climb, remaining_m);
}

Pose2 goal_pose(const RoutePoint& point) {
  return {point.p_map.x(), point.p_map.y(), heading_of(point.direction)};
}

}  // namespace

std::optional<FrontierCandidate> Exploration::choose(
    const ExplorationState& state, const std::vector<FrontierCandidate>& candidates) const {
  const std::optional<int> id = choose_id(state, candidates);
  const auto chosen =
      std::ranges::find_if(candidates, [&](const auto& each) { return each.frontier == id; });
  return chosen == candidates.end() ? std::nullopt : std::optional(*chosen);
}

std::optional<int> Exploration::choose_id(const ExplorationState& state,
                                          const std::vector<FrontierCandidate>& candidates) const {
  if (params_.mode == "corridor") return straight_ahead(state, candidates);
  if (params_.choice.rule != "tour") {
    return choose_by_rule(params_.choice.rule, candidates, frontiers(), state.T_map_body,
                          decision_.frontier);
  }
  const Frontier* target = register_.find(decision_.frontier);
  const auto target_id = target == nullptr ? std::nullopt : std::optional(target->id);
  const auto near = nearest_candidates(candidates, target_id, params_.choice);
  return choose_frontier(near, path_lengths_between(near), target_id, params_.choice);
}

/// Path lengths between all pairs of these frontiers [m].
Eigen::MatrixXd Exploration::path_lengths_between(
    const std::vector<FrontierCandidate>& candidates) const {
  const auto n = static_cast<Eigen::Index>(candidates.size());
  Eigen::MatrixXd path_lengths = Eigen::MatrixXd::Zero(n, n);
  if (n < 2) return path_lengths;
  std::vector<Eigen::Vector2d> positions;
  for (const FrontierCandidate& candidate : candidates)
    positions.push_back(register_.find(candidate.frontier)->p_map);
  for (Eigen::Index i = 0; i + 1 < n; ++i) {
    const std::vector<Eigen::Vector2d> others(positions.begin() + i + 1, positions.end());
    const ShortestPathTree from_i(space_, positions[static_cast<std::size_t>(i)],
                                  PathPreference::kAnyDrivable, others);
    for (Eigen::Index j = i + 1; j < n; ++j) {
      const auto leg = from_i.distance_m(positions[static_cast<std::size_t>(j)]);
      path_lengths(i, j) = path_lengths(j, i) = leg.value_or(kNoPathM);
    }
  }
  return path_lengths;
}

/// The frontier with the smallest bearing off the heading (paper, section 3.3).
std::optional<int> Exploration::straight_ahead(
    const ExplorationState& state, const std::vector<FrontierCandidate>& candidates) const {
  const Eigen::Vector2d ahead(std::cos(state.T_map_body.theta), std::sin(state.T_map_body.theta));
  std::optional<int> best;
  double least = kStraightAheadRad;
  for (const FrontierCandidate& candidate : candidates) {
    const Eigen::Vector2d leg =
        in_map(*register_.find(candidate.frontier)).p_map - state.T_map_body.translation();
    const double off = candidate.path_length_m < 1.0 ? 0.0 : angle_between(leg, ahead);
    if (candidate.path_length_m > kStraightAheadM || off >= least) continue;
    least = off;
    best = candidate.frontier;
  }
  return best;
}

/// Sum of the climbs along a path in atlas [m]. Less than 0.3 m at a time is none: so much do the
/// heights of local maps of level ground vary.
double Exploration::climb_m(const std::vector<Eigen::Vector2d>& path) const {
  constexpr double kLeastM = 0.3;
  constexpr std::size_t kEvery = 25;  // cells: 5 m, as local maps
  double climb = 0.0;
  std::optional<double> low;
  for (std::size_t i = 0; i < path.size(); i += kEvery) {
    const auto z_m = known_.height_near(path[i]);
    if (!z_m) return 0.0;
    if (low && *z_m > *low + kLeastM) {
      climb += *z_m - *low;
      low = z_m;
    }
    low = std::min(low.value_or(*z_m), *z_m);
  }
  return climb;
}

FrontierCandidate Exploration::with_climb(FrontierCandidate candidate,
                                          const Eigen::Vector2d& p_atlas,
                                          const ShortestPathTree& here) const {
  std::vector<Eigen::Vector2d> there = here.path_from(p_atlas);
  std::reverse(there.begin(), there.end());
  candidate.climb_m = climb_m(there);
  candidate.return_climb_m = climb_m(from_home_->path_from(p_atlas));
  return candidate;
}

/// Open frontiers within the budget; marks the others as beyond it.
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
    const FrontierCandidate candidate = with_climb(
        {frontier.id, expected_gain_m(frontier, space_, mean_m, state.sd_m, params_.gain), *leg,
         *home},
        frontier.p_map, here);
    const bool within =
        is_within_budget(candidate, params_.step_m, state.remaining_m, params_.choice);
    register_.set_within_budget(frontier.id, within, budget_evidence(candidate, state.remaining_m),
                                state.utime);
    if (within) candidates.push_back(candidate);
  }
  return candidates;
}

ExplorationDecision Exploration::to_frontier(const FrontierCandidate& candidate,
                                             const ExplorationState& state,
                                             const ShortestPathTree& here) {
  route_ = here.path_from(register_.find(candidate.frontier)->p_map);
  const Frontier frontier = in_map(*register_.find(candidate.frontier));
  std::reverse(route_.begin(), route_.end());
  ExplorationDecision decision;
  decision.frontier = frontier.id;
  decision.distance_m = candidate.path_length_m;
  const Eigen::Vector2d leg = frontier.p_map - state.T_map_body.translation();
  const bool straight = decision.distance_m < kAtFrontierM ||
                        (decision.distance_m < 1.1 * leg.norm() &&
                         angle_between(leg, frontier.direction_map) < kAlongRad);
  if (decision.distance_m <= params_.step_m && straight) {
    decision.kind = ExplorationDecision::Kind::kAlong;
    decision.T_map_goal = {frontier.p_map.x(), frontier.p_map.y(),
                           heading_of(frontier.direction_map)};
    decision.reason = fmt::format("straight ahead to frontier {}", frontier.id);
    return decision;
  }
  decision.kind = ExplorationDecision::Kind::kGoTo;
  decision.T_map_goal = goal_pose(point_along(route(), params_.step_m));
  decision.reason = fmt::format("to frontier {}, {:.0f} m away", frontier.id, decision.distance_m);
  return decision;
}

ExplorationDecision Exploration::to_home(const ExplorationState& state, double path_length_m,
                                         std::string reason) {
  ExplorationDecision decision;
  const Pose2 home = T_map_home();
  route_ = from_home_->path_from(p_atlas_body(state));
  decision.distance_m = path_length_m;
  decision.complete = incomplete_reasons().empty();
  decision.reason = std::move(reason);
  if ((p_atlas_body(state) - home.translation()).norm() <= params_.at_home_m) {
    decision.kind = ExplorationDecision::Kind::kDone;
    decision.T_map_goal = state.T_map_body;
    return decision;
  }
  decision.kind = ExplorationDecision::Kind::kHome;
  if (decision.distance_m <= kHomeAheadM) {
    decision.T_map_goal = home;
    return decision;
  }
  decision.T_map_goal = goal_pose(point_along(route(), params_.step_m));
  return decision;
}

std::vector<PatrolPlace> Exploration::patrol_places() const {
  std::vector<PatrolPlace> places;
  const std::optional<PosedTile> newest = known_.newest();
  if (!params_.patrol || !newest) return places;
  for (int id = 0; id <= newest->id; ++id) {
    if (const auto T_map_local = known_.pose_of(id)) {
      places.push_back({id, T_map_local->translation()});
    }
  }
  return places;
}

/// For an explored mine. Empty if no patrol place is within the budget.
std::optional<ExplorationDecision> Exploration::to_next_patrol_place(const ExplorationState& state,
                                                                     const ShortestPathTree& here) {
  std::vector<PatrolPlace> within = patrol_places();
  std::erase_if(within, [&](const PatrolPlace& place) {
    const auto leg = here.distance_m(place.p_map);
    const auto home = from_home_->distance_m(place.p_map);
    return !leg || !home ||
           !is_within_budget(with_climb({-1, 0.0, *leg, *home}, place.p_map, here), 0.0,
                             state.remaining_m, params_.choice);
  });
  patrol_target_ = patrol_.next(within);
  if (!patrol_target_) return std::nullopt;
  const std::optional<double> path_length_m = here.distance_m(patrol_target_->p_map);
  if (!path_length_m) return std::nullopt;  // such places were removed above
  route_ = here.path_from(patrol_target_->p_map);
  std::reverse(route_.begin(), route_.end());
  ExplorationDecision decision;
  decision.kind = ExplorationDecision::Kind::kGoTo;
  decision.distance_m = *path_length_m;
  decision.complete = incomplete_reasons().empty();
  decision.T_map_goal = goal_pose(point_along(route(), params_.step_m));
  decision.reason =
      fmt::format("patrol to the start of local map {}, {:.0f} m away, visited longest ago",
                  patrol_target_->local_map, decision.distance_m);
  return decision;
}

/// Whether the line straight ahead from a frontier leads away from the robot. If it came back, a
/// planner that follows the path as far as possible would reach its end without having visited the
/// frontier.
bool Exploration::leads_away(const Frontier& frontier) const {
  const Eigen::Vector2d leg = frontier.p_map - state_.T_map_body.translation();
  return leg.norm() < kAtFrontierM || leg.dot(frontier.direction_map) >= 0.0;
}

/// Whether the vehicle fits there, or nothing is known about the place.
bool Exploration::fits_as_far_as_known(const Eigen::Vector2d& p_atlas) const {
  const Eigen::Vector2i cell = space_.cell_at(p_atlas);
  return space_.known.get(cell, Occupancy::kUnseen) == Occupancy::kUnseen ||
         space_.access.get(cell) != Access::kNone;
}

/// Distance beyond a frontier in atlas, up to `length_m`, before it would lead into known rock.
double Exploration::straight_on_m(const Frontier& frontier, double length_m) const {
  double free_m = 0.0;
  while (free_m < length_m && fits_as_far_as_known(frontier.p_map + (free_m + space_.resolution_m) *
                                                                        frontier.direction_map)) {
    free_m += space_.resolution_m;
  }
  return std::min(free_m, length_m);
}

std::vector<Eigen::Vector2d> Exploration::path_ahead(double length_m, double spacing_m) const {
  using Kind = ExplorationDecision::Kind;
  if (decision_.kind == Kind::kStay || decision_.kind == Kind::kDone) return {};
  std::vector<Eigen::Vector2d> line{state_.T_map_body.translation()};
  for (const Eigen::Vector2d& p_atlas : route_) line.push_back(known_.atlas().to_map(p_atlas));
  if (register_.find(decision_.frontier) != nullptr) {
    const Frontier frontier = in_map(*register_.find(decision_.frontier));
    line.push_back(frontier.p_map);
    const double on_m = straight_on_m(*register_.find(decision_.frontier), kScanRangeM);
    if (leads_away(frontier)) line.emplace_back(frontier.p_map + on_m * frontier.direction_map);
  } else {
    line.push_back(patrol_target_ ? known_.atlas().to_map(patrol_target_->p_map)
                                  : T_map_home().translation());
  }
  const std::vector<Eigen::Vector2d> points = resampled(line, length_m, spacing_m);
  const auto fits = [&](const Eigen::Vector2d& p_map) {
    for (int layer = 0; layer < known_.atlas().layers(); ++layer) {
      if (fits_as_far_as_known(known_.atlas().to_atlas(p_map, layer))) return true;
    }
    return false;
  };
  // Less smooth where that would cut a corner, within the range of a scan and beyond it.
  const auto smooth = [&](const std::vector<Eigen::Vector2d>& part) {
    for (int reach = kSmoothedWith; reach > 0; --reach) {
      std::vector<Eigen::Vector2d> path = moving_average(part, reach);
      if (std::ranges::all_of(path, fits)) return path;
    }
    return part;
  };
  const auto near_points =
      std::min(points.size(), static_cast<std::size_t>(kScanRangeM / spacing_m) + 1);
  const auto near_end = points.begin() + static_cast<std::ptrdiff_t>(near_points);
  std::vector<Eigen::Vector2d> path = smooth({points.begin(), near_end});
  const std::vector<Eigen::Vector2d> beyond = smooth({near_end - 1, points.end()});
  path.insert(path.end(), beyond.begin() + 1, beyond.end());
  return path;
}

}  // namespace adit
