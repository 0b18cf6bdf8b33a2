// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Where no way leads on: barriers, by what the planner said, and what they close.
#include <algorithm>
#include <utility>

#include "procs/exploration/exploration.hpp"
#include "procs/exploration/route_place.hpp"

namespace adit {
namespace {

constexpr double kBehindStartM = 0.5;    // of the rear of the vehicle
constexpr double kWayOutM = 10.0;        // from the start, where an open end may lead out
constexpr double kOutwards = -0.3;       // of its direction, against the heading of the start
constexpr double kBeyondReachedM = 0.8;  // of the farthest place that the planner reached

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

}  // namespace

/// From outside nothing comes back, so that what is known may end before the barrier does.
bool Exploration::leads_out(const OpenEnd& end) const {
  if (!params_.way_out_behind) return false;
  const Pose2 T_home_map = T_map_home().inverse();
  const Eigen::Vector2d p_home = T_home_map * end.p_map;
  const Eigen::Vector2d direction = T_home_map * end.direction_map - T_home_map.translation();
  return p_home.norm() < kWayOutM && p_home.x() < params_.vehicle.length_m / 2.0 &&
         direction.x() < kOutwards;
}

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
  if (!is_cut_off(state_)) return true;
  barriers_.pop_back();
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

}  // namespace adit
