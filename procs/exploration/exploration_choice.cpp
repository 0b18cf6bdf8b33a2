// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Where to go: to which stub, home, or on patrol, and along which way.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "common/geometry/smooth_line.hpp"
#include "procs/exploration/exploration.hpp"
#include "procs/exploration/route_place.hpp"
#include "procs/exploration/simple_rules.hpp"

namespace adit {
namespace {

constexpr int kSmoothedWith = 3;        // neighbours to each side, against the steps of cells
constexpr double kAlongRad = 0.6;       // between the way to a stub and the way on from there
constexpr double kStraightOnRad = 1.0;  // that a corridor may bend, in the mode corridor
constexpr double kStraightOnM = 30.0;   // how far ahead its open end may be
constexpr double kAtStubM = 1.5;        // too near to a stub for a direction
constexpr double kHomeAheadM = 12.0;    // the next goal, and not a place on the way there
constexpr double kNoWayM = 1e6;

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
                                       const std::vector<StubOffer>& offers) const {
  if (params_.mode == "corridor") return straight_on(state, offers);
  if (params_.choice.rule != "tour") {
    return choose_by(params_.choice.rule, offers, register_.stubs(), state.T_map_body,
                     decision_.stub);
  }
  const Stub* target = register_.find(decision_.stub);
  const auto target_id = target == nullptr ? std::nullopt : std::optional(target->id);
  const auto near = nearest_offers(offers, target_id, params_.choice);
  return choose_stub(near, ways_between(near), target_id, params_.choice);
}

/// Ways between all of these stubs [m].
Eigen::MatrixXd Exploration::ways_between(const std::vector<StubOffer>& offers) const {
  const auto n = static_cast<Eigen::Index>(offers.size());
  Eigen::MatrixXd ways = Eigen::MatrixXd::Zero(n, n);
  if (n < 2) return ways;
  std::vector<Eigen::Vector2d> places;
  for (const StubOffer& offer : offers) places.push_back(register_.find(offer.stub)->p_map);
  for (Eigen::Index i = 0; i + 1 < n; ++i) {
    const std::vector<Eigen::Vector2d> others(places.begin() + i + 1, places.end());
    const TravelField field(space_, places[static_cast<std::size_t>(i)], Trust::kSeen, others);
    for (Eigen::Index j = i + 1; j < n; ++j) {
      const auto way = field.distance_m(places[static_cast<std::size_t>(j)]);
      ways(i, j) = ways(j, i) = way.value_or(kNoWayM);
    }
  }
  return ways;
}

/// The open end that lies ahead most nearly straight (paper, section 3.3).
std::optional<int> Exploration::straight_on(const ExplorationState& state,
                                            const std::vector<StubOffer>& offers) const {
  const Eigen::Vector2d ahead(std::cos(state.T_map_body.theta), std::sin(state.T_map_body.theta));
  std::optional<int> best;
  double least = kStraightOnRad;
  for (const StubOffer& offer : offers) {
    const Eigen::Vector2d way = register_.find(offer.stub)->p_map - state.T_map_body.translation();
    const double off = offer.way_m < 1.0 ? 0.0 : angle_between(way, ahead);
    if (offer.way_m > kStraightOnM || off >= least) continue;
    least = off;
    best = offer.stub;
  }
  return best;
}

/// Of the open stubs those within the budget; the others are marked as beyond it.
std::vector<StubOffer> Exploration::offers(const ExplorationState& state, const TravelField& here) {
  const double mean_m = mean_corridor_m(corridors_, params_.gain);
  std::vector<StubOffer> offers;
  for (std::size_t i = 0; i < register_.stubs().size(); ++i) {
    const Stub& stub = register_.stubs()[i];
    if (!is_to_visit(stub.state)) continue;
    const auto way = here.distance_m(stub.p_map);
    const auto home = from_home_->distance_m(stub.p_map);
    if (!way || !home) continue;
    const StubOffer offer{stub.id, expected_gain_m(stub, space_, mean_m, state.sd_m, params_.gain),
                          *way, *home};
    const bool within = is_within_budget(offer, params_.step_m, state.remaining_m, params_.choice);
    register_.set_within_budget(stub.id, within,
                                "it is " + metres(*way) + " away and " + metres(*home) +
                                    " from home, of " + metres(state.remaining_m) +
                                    " that are left",
                                state.utime);
    if (within) offers.push_back(offer);
  }
  return offers;
}

ExplorationDecision Exploration::to_stub(int id, const ExplorationState& state,
                                         const TravelField& here) {
  const Stub& stub = *register_.find(id);
  route_ = here.way_from(stub.p_map);
  std::reverse(route_.begin(), route_.end());
  ExplorationDecision decision;
  decision.stub = id;
  decision.distance_m = here.distance_m(stub.p_map).value_or(0.0);
  const Eigen::Vector2d way = stub.p_map - state.T_map_body.translation();
  const bool straight =
      decision.distance_m < kAtStubM || (decision.distance_m < 1.1 * way.norm() &&
                                         angle_between(way, stub.direction_map) < kAlongRad);
  if (decision.distance_m <= params_.step_m && straight) {
    decision.kind = ExplorationDecision::Kind::kAlong;
    decision.T_map_goal = {stub.p_map.x(), stub.p_map.y(), heading_of(stub.direction_map)};
    decision.reason = "straight on to stub " + std::to_string(id);
    return decision;
  }
  const RoutePlace place = along(route_, params_.step_m);
  decision.kind = ExplorationDecision::Kind::kGoTo;
  decision.T_map_goal = {place.p_map.x(), place.p_map.y(), heading_of(place.direction)};
  decision.reason =
      "to stub " + std::to_string(id) + ", " + metres(decision.distance_m) + " from here";
  return decision;
}

ExplorationDecision Exploration::to_home(const ExplorationState& state, std::string reason) {
  ExplorationDecision decision;
  const Pose2 home = T_map_home();
  route_ = from_home_->way_from(state.T_map_body.translation());
  decision.distance_m = from_home_->distance_m(state.T_map_body.translation()).value_or(0.0);
  decision.complete = reasons_why_not_complete().empty();
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
  const RoutePlace place = along(route_, params_.step_m);
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
std::optional<ExplorationDecision> Exploration::to_longest_ago(const ExplorationState& state,
                                                               const TravelField& here) {
  std::vector<PatrolPlace> within = places();
  std::erase_if(within, [&](const PatrolPlace& place) {
    const auto way = here.distance_m(place.p_map);
    const auto home = from_home_->distance_m(place.p_map);
    return !way || !home ||
           !is_within_budget({-1, 0.0, *way, *home}, 0.0, state.remaining_m, params_.choice);
  });
  patrolled_ = patrol_.next(within);
  if (!patrolled_) return std::nullopt;
  route_ = here.way_from(patrolled_->p_map);
  std::reverse(route_.begin(), route_.end());
  ExplorationDecision decision;
  decision.kind = ExplorationDecision::Kind::kGoTo;
  decision.distance_m = here.distance_m(patrolled_->p_map).value_or(0.0);
  decision.complete = reasons_why_not_complete().empty();
  const RoutePlace place = along(route_, params_.step_m);
  decision.T_map_goal = {place.p_map.x(), place.p_map.y(), heading_of(place.direction)};
  decision.reason = "on patrol to where local map " + std::to_string(patrolled_->local_map) +
                    " began, " + metres(decision.distance_m) + " from here, seen longest ago";
  return decision;
}

/// Not where the way on from a stub would come back to the robot: who follows it as far as it can
/// would get to its end without ever having gone to the stub.
bool Exploration::leads_on(const Stub& stub) const {
  const Eigen::Vector2d way = stub.p_map - state_.T_map_body.translation();
  return way.norm() < kAtStubM || way.dot(stub.direction_map) >= 0.0;
}

std::vector<Eigen::Vector2d> Exploration::next_way(double length_m, double spacing_m) const {
  using Kind = ExplorationDecision::Kind;
  if (decision_.kind == Kind::kStay || decision_.kind == Kind::kDone) return {};
  std::vector<Eigen::Vector2d> line{state_.T_map_body.translation()};
  line.insert(line.end(), route_.begin(), route_.end());
  const Stub* stub = register_.find(decision_.stub);
  if (stub != nullptr) {
    line.push_back(stub->p_map);
    if (leads_on(*stub)) line.emplace_back(stub->p_map + length_m * stub->direction_map);
  } else {
    line.push_back(patrolled_ ? patrolled_->p_map : T_map_home().translation());
  }
  return smoothed(thinned(line, length_m, spacing_m), kSmoothedWith);
}

}  // namespace adit
