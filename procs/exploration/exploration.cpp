// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/exploration.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "common/geometry/smooth_line.hpp"
#include "procs/exploration/simple_rules.hpp"
#include "procs/exploration/skeleton.hpp"

namespace adit {
namespace {

constexpr int kSmoothedWith = 3;        // neighbours to each side, against the steps of cells
constexpr double kAlongRad = 0.6;       // between the way to a stub and the way on from there
constexpr double kStraightOnRad = 1.0;  // that a corridor may bend, in the mode corridor
constexpr double kStraightOnM = 30.0;   // how far ahead its open end may be
constexpr double kHeadingOverM = 1.5;   // of a route
constexpr double kHomeAheadM = 12.0;    // the next goal, and not a place on the way there
constexpr double kNoWayM = 1e6;
constexpr double kBehindStartM = 0.5;    // of the rear of the vehicle
constexpr double kWayOutM = 10.0;        // from the start, where an open end may lead out
constexpr double kOutwards = -0.3;       // of its direction, against the heading of the start
constexpr double kBeyondReachedM = 0.8;  // of the farthest place that the planner reached

std::string metres(double metres) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.0f m", metres);
  return text;
}

/// How far along a route, and its direction there.
struct RoutePlace {
  Eigen::Vector2d p_map{0.0, 0.0};
  Eigen::Vector2d direction{1.0, 0.0};
};

RoutePlace along(const std::vector<Eigen::Vector2d>& route, double distance_m) {
  std::size_t at = 0;
  for (double way = 0.0; at + 1 < route.size(); ++at) {
    way += (route[at + 1] - route[at]).norm();
    if (way > distance_m) break;
  }
  std::size_t before = at;
  while (before > 0 && (route[before] - route[at]).norm() < kHeadingOverM) --before;
  std::size_t after = at;
  while (before == at && after + 1 < route.size() &&
         (route[after] - route[at]).norm() < kHeadingOverM) {
    ++after;
  }
  const Eigen::Vector2d direction = route[after] - route[before];
  return {route[at], direction.norm() > 0.0 ? direction.normalized() : Eigen::Vector2d::UnitX()};
}

/// Places `spacing_m` apart of a line, as far as `length_m` along it.
std::vector<Eigen::Vector2d> thinned(const std::vector<Eigen::Vector2d>& line, double length_m,
                                     double spacing_m) {
  std::vector<Eigen::Vector2d> places{line.front()};
  double next_m = spacing_m;
  double way_m = 0.0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double leg_m = (line[i + 1] - line[i]).norm();
    for (; next_m <= std::min(way_m + leg_m, length_m); next_m += spacing_m) {
      places.emplace_back(line[i] + (next_m - way_m) / leg_m * (line[i + 1] - line[i]));
    }
    way_m += leg_m;
  }
  if (way_m <= length_m) places.push_back(line.back());
  return places;
}

double heading_of(const Eigen::Vector2d& direction) {
  return std::atan2(direction.y(), direction.x());
}

double angle_between(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::abs(angle_diff(heading_of(a), heading_of(b)));
}

StubState state_behind(Barrier::Kind barrier) {
  switch (barrier) {
    case Barrier::Kind::kBlocked:
      return StubState::kBlocked;
    case Barrier::Kind::kWayOut:
      return StubState::kWayOut;
    case Barrier::Kind::kDoubtful:
      return StubState::kDoubtful;
  }
  return StubState::kBlocked;
}

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

/// From outside nothing comes back, so that what is known may end before the barrier does.
bool Exploration::leads_out(const OpenEnd& end) const {
  if (!params_.way_out_behind) return false;
  const Pose2 T_home_map = T_map_home().inverse();
  const Eigen::Vector2d p_home = T_home_map * end.p_map;
  const Eigen::Vector2d direction = T_home_map * end.direction_map - T_home_map.translation();
  return p_home.norm() < kWayOutM && p_home.x() < params_.vehicle.length_m / 2.0 &&
         direction.x() < kOutwards;
}

/// The start is where the first local map began.
Pose2 Exploration::T_map_home() const { return known_.pose_of(0).value_or(Pose2{}); }

void Exploration::add_way_out() {
  if (!params_.way_out_behind || !barriers_.empty() || !known_.pose_of(0)) return;
  const double behind = params_.vehicle.length_m / 2.0 + kBehindStartM;
  barriers_.push_back({Barrier::Kind::kWayOut,
                       -1,
                       0,
                       {-behind, 0.0},
                       {-1.0, 0.0},
                       "behind the start: the way out"});
}

/// A doubt about a way home is none about ground that has carried the robot.
std::vector<Cut> Exploration::cuts() const {
  std::vector<Cut> cuts;
  for (const Barrier& barrier : barriers_) {
    const auto T_map_local = known_.pose_of(barrier.local_map);
    if (!T_map_local) continue;
    const bool spares_driven =
        barrier.kind == Barrier::Kind::kDoubtful && barrier.stub == ExplorationDecision::kNoStub;
    cuts.push_back({*T_map_local * barrier.p_local,
                    *T_map_local * barrier.direction_local - T_map_local->translation(),
                    spares_driven});
  }
  return cuts;
}

std::vector<StubRegister::BarrierText> Exploration::barrier_texts() const {
  std::vector<StubRegister::BarrierText> texts;
  for (const Barrier& barrier : barriers_) {
    const auto T_map_local = known_.pose_of(barrier.local_map);
    if (!T_map_local) continue;
    texts.push_back({*T_map_local * barrier.p_local, state_behind(barrier.kind), barrier.evidence});
  }
  return texts;
}

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

bool Exploration::is_cut_off(const ExplorationState& state) const {
  return !from_home_->distance_m(state.T_map_body.translation());
}

/// A robot behind a barrier has come past it, and so there is a way: the newest without which it is
/// not cut off is none, or all of them are none. Where that does not help, the reason is another.
void Exploration::drop_passed_barriers(const ExplorationState& state) {
  const std::vector<Barrier> all = barriers_;
  const auto is_way_out = [](const Barrier& b) { return b.kind == Barrier::Kind::kWayOut; };
  if (std::all_of(all.begin(), all.end(), is_way_out)) return;
  for (std::size_t i = all.size(); i-- > 0 && is_cut_off(state);) {
    if (is_way_out(all[i])) continue;
    barriers_ = all;
    barriers_.erase(barriers_.begin() + static_cast<std::ptrdiff_t>(i));
    refresh();
  }
  if (!is_cut_off(state)) return;
  std::erase_if(barriers_, [&](const Barrier& barrier) { return !is_way_out(barrier); });
  refresh();
  if (!is_cut_off(state)) return;
  barriers_ = all;
  refresh();
}

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
      decision.distance_m < kHeadingOverM || (decision.distance_m < 1.1 * way.norm() &&
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
  return way.norm() < kHeadingOverM || way.dot(stub.direction_map) >= 0.0;
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

bool Exploration::report_blocked(int stub, const BlockedEvidence& evidence) {
  if (patrolled_ && stub == ExplorationDecision::kNoStub) {
    patrol_.give_up(patrolled_->local_map, evidence.utime);
    return true;
  }
  const bool way_home =
      stub == ExplorationDecision::kNoStub && decision_.kind == ExplorationDecision::Kind::kHome;
  const Stub* target = register_.find(stub);
  if (!way_home && (target == nullptr || target->state == StubState::kExplored)) return false;
  const bool on_the_way = decision_.stub == stub && !route_.empty();
  // What is in the way far from the stub says nothing of the stub: there may be another way.
  const bool far = on_the_way && decision_.distance_m > params_.step_m;
  if (!far) register_.block(stub, evidence.doubtful, evidence.reason, evidence.utime);
  if (!on_the_way) return true;
  const RoutePlace place = along(route_, std::max(evidence.reached_m, 0.0) + kBeyondReachedM);
  const auto tie = known_.tile_at(place.p_map);
  if (!tie) return true;
  const Pose2 T_local_map = known_.pose_of(*tie)->inverse();
  const std::string where =
      way_home ? "on the way home: " : "behind stub " + std::to_string(stub) + ": ";
  barriers_.push_back({evidence.doubtful ? Barrier::Kind::kDoubtful : Barrier::Kind::kBlocked, stub,
                       *tie, T_local_map * place.p_map,
                       T_local_map * place.direction - T_local_map.translation(),
                       where + evidence.reason});
  refresh();
  if (from_home_->distance_m(state_.T_map_body.translation())) return true;
  barriers_.pop_back();  // it would cut off the robot
  register_.block(stub, evidence.doubtful, evidence.reason, evidence.utime);
  refresh();
  return true;
}

/// When nothing else is left, and from wherever the robot is by then. A line across a junction may
/// lie across another drift as well, and what is in the way of one stub is no evidence for another.
/// What has its own stays closed without barriers.
bool Exploration::retry_given_up(std::int64_t utime) {
  if (!register_.retry_given_up(utime)) return false;
  std::erase_if(barriers_, [](const Barrier& barrier) { return barrier.stub >= 0; });
  refresh();
  return true;
}

bool Exploration::reopen(int stub, std::int64_t utime) {
  if (!register_.reopen(stub, "reopened by a person", utime)) return false;
  std::erase_if(barriers_, [&](const Barrier& barrier) { return barrier.stub == stub; });
  refresh();
  return true;
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
