// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/stub_register.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace adit {
namespace {

constexpr double kNearerM = 1.0;              // less is none
constexpr double kShiftM = 0.5;               // by which maps may move against each other
const double kAdvanceCosine = std::cos(1.0);  // of the angle by which a corridor may bend

void set(Stub& stub, StubState state, std::string evidence, std::int64_t utime) {
  if (stub.state == state) return;
  stub.state = state;
  stub.evidence = std::move(evidence);
  stub.utime = utime;
}

bool lies_ahead(const Stub& stub, const Eigen::Vector2d& p_map) {
  const Eigen::Vector2d way = p_map - stub.p_map;
  return way.dot(stub.direction_map) > kAdvanceCosine * way.norm();
}

std::string seen_by(std::optional<int> local_map) {
  if (!local_map) return "what lies there was seen";
  return "what lies there was seen by local map " + std::to_string(*local_map);
}

}  // namespace

void StubRegister::update(const std::vector<OpenEnd>& ends, const KnownSpace& space,
                          const std::vector<BarrierText>& barriers, std::int64_t utime) {
  move_with_the_graph(space);
  std::vector<bool> found(stubs_.size());
  std::vector<bool> taken(ends.size());
  for (const Search search : {Search::kHere, Search::kOnward, Search::kReopened}) {
    match(ends, space, search, found, taken);
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!found[i] && !holds_[i].final) close(i, space, utime);
  }
  for (std::size_t k = 0; k < ends.size(); ++k) {
    if (taken[k]) continue;
    Stub stub;
    stub.id = static_cast<int>(stubs_.size());
    stub.utime = utime;
    stubs_.push_back(stub);
    holds_.emplace_back();
    closings_.emplace_back();
    place(stubs_.size() - 1, ends[k], space);
    judge(stubs_.size() - 1, ends[k].access, barriers, utime);
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!found[i]) continue;
    const auto end = std::find_if(ends.begin(), ends.end(), [&](const OpenEnd& candidate) {
      return candidate.p_map == stubs_[i].p_map;
    });
    judge(i, end->access, barriers, utime);
  }
  confirm_closed(ends, space);
}

void StubRegister::move_with_the_graph(const KnownSpace& space) {
  for (std::size_t i = 0; i < stubs_.size(); ++i) {
    Stub& stub = stubs_[i];
    const auto T_map_local = space.pose_of(stub.local_map);
    if (!T_map_local) continue;
    stub.p_map = *T_map_local * holds_[i].p_local;
    stub.direction_map = *T_map_local * holds_[i].direction_local - T_map_local->translation();
  }
}

bool StubRegister::may_be(std::size_t i, const OpenEnd& end, Search search) const {
  const bool explored = stubs_[i].state == StubState::kExplored;
  if (explored != (search == Search::kReopened)) return false;
  const double distance = (end.p_map - stubs_[i].p_map).norm();
  if (search != Search::kOnward) return distance <= params_.match_m;
  return !holds_[i].final && distance <= params_.advance_m && lies_ahead(stubs_[i], end.p_map);
}

/// Nearest pairs first.
void StubRegister::match(const std::vector<OpenEnd>& ends, const KnownSpace& space, Search search,
                         std::vector<bool>& found, std::vector<bool>& taken) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (std::size_t k = 0; k < ends.size(); ++k) {
      if (found[i] || taken[k] || !may_be(i, ends[k], search)) continue;
      pairs.push_back({(ends[k].p_map - stubs_[i].p_map).norm(), i, k});
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return std::tie(a.distance_m, a.stub, a.end) < std::tie(b.distance_m, b.stub, b.end);
  });
  for (const Pair& pair : pairs) {
    if (found[pair.stub] || taken[pair.end]) continue;
    taken[pair.end] = true;
    if (search == Search::kReopened && is_seam(pair.stub, ends[pair.end], space)) continue;
    found[pair.stub] = true;
    place(pair.stub, ends[pair.end], space);
  }
}

/// What lies there was seen; after so many times, for good.
void StubRegister::close(std::size_t i, const KnownSpace& space, std::int64_t utime) {
  if (stubs_[i].state == StubState::kExplored) return;
  const std::optional<int> newest = space.newest();
  set(stubs_[i], StubState::kExplored, seen_by(newest), utime);
  holds_[i].final = ++holds_[i].closings >= params_.closings;
  if (!newest) return;
  closings_[i] = {newest, space.pose_of(*newest)->inverse() * stubs_[i].p_map, *newest};
}

/// It was seen to be closed, nobody has seen the place since nothing was open there, and who saw it
/// lies as he did.
bool StubRegister::is_seam(std::size_t i, const OpenEnd& end, const KnownSpace& space) const {
  const Closing& closing = closings_[i];
  if (!closing.local_map || space.newest_at(end.p_map).value_or(0) > closing.up_to) return false;
  const auto T_map_local = space.pose_of(*closing.local_map);
  return T_map_local && (*T_map_local * closing.p_local - stubs_[i].p_map).norm() <= kShiftM;
}

void StubRegister::confirm_closed(const std::vector<OpenEnd>& ends, const KnownSpace& space) {
  for (std::size_t i = 0; i < stubs_.size(); ++i) {
    const bool open = std::ranges::any_of(ends, [&](const OpenEnd& end) {
      return (end.p_map - stubs_[i].p_map).norm() <= params_.match_m;
    });
    if (stubs_[i].state == StubState::kExplored && !open) {
      closings_[i].up_to = space.newest().value_or(0);
    }
  }
}

void StubRegister::place(std::size_t i, const OpenEnd& end, const KnownSpace& space) {
  Stub& stub = stubs_[i];
  stub.p_map = end.p_map;
  stub.direction_map = end.direction_map;
  stub.width_m = end.width_m;
  stub.local_map = space.tile_at(end.p_map).value_or(space.newest().value_or(0));
  const Pose2 T_local_map = space.pose_of(stub.local_map).value_or(Pose2{}).inverse();
  holds_[i].p_local = T_local_map * end.p_map;
  holds_[i].direction_local = T_local_map * end.direction_map - T_local_map.translation();
}

void StubRegister::judge(std::size_t i, Access access, const std::vector<BarrierText>& barriers,
                         std::int64_t utime) {
  Stub& stub = stubs_[i];
  if (holds_[i].final) return;
  if (access == Access::kReachable) {
    if (stub.state != StubState::kBeyondBudget) set(stub, StubState::kOpen, {}, utime);
    return;
  }
  if (access == Access::kBehindBarrier && !barriers.empty()) {
    const auto nearest = std::min_element(
        barriers.begin(), barriers.end(), [&](const BarrierText& a, const BarrierText& b) {
          return (a.p_map - stub.p_map).norm() < (b.p_map - stub.p_map).norm();
        });
    return set(stub, nearest->state, nearest->evidence, utime);
  }
  set(stub, StubState::kTooNarrow, "no known way there is wide enough for the vehicle", utime);
}

/// From wherever the robot is now; what stalled before is remembered until it comes nearer.
void StubRegister::begin_pursuit(int stub) {
  if (find(stub) != nullptr) holds_[static_cast<std::size_t>(stub)].least_way_m = StubHold::kNever;
}

void StubRegister::pursued(int stub, double way_m, int local_map, std::int64_t utime) {
  if (find(stub) == nullptr) return;
  Stub& target = stubs_[static_cast<std::size_t>(stub)];
  StubHold& hold = holds_[static_cast<std::size_t>(stub)];
  if (target.state != StubState::kOpen) return;
  const bool moved = (target.p_map - hold.p_then).norm() > params_.match_m;
  if (moved || way_m < hold.least_way_m - kNearerM) {
    if (hold.least_way_m < StubHold::kNever) hold.stalls = 0;
    hold.least_way_m = way_m;
    hold.p_then = target.p_map;
    return;
  }
  if (++hold.stalls < params_.stalls) return;
  hold.final = true;
  set(target, StubState::kUnseeable,
      "up to local map " + std::to_string(local_map) + ", " + std::to_string(hold.stalls) +
          " in a row came no nearer and saw nothing of it",
      utime);
}

bool StubRegister::block(int stub, bool doubtful, std::string evidence, std::int64_t utime) {
  if (find(stub) == nullptr || find(stub)->state == StubState::kExplored) return false;
  const auto i = static_cast<std::size_t>(stub);
  holds_[i].final = true;
  const StubState state = doubtful ? StubState::kDoubtful : StubState::kBlocked;
  set(stubs_[i], state, std::move(evidence), utime);
  return true;
}

bool StubRegister::retry_given_up(std::int64_t utime) {
  bool any = false;
  for (std::size_t i = 0; i < stubs_.size(); ++i) {
    const bool given_up = is_given_up(stubs_[i].state);
    const bool presumed = stubs_[i].state == StubState::kBlocked && !holds_[i].final;
    if (holds_[i].retried || (!given_up && !presumed)) continue;
    if (given_up) reopen(stubs_[i].id, "it was given up, and is tried once more", utime);
    any = holds_[i].retried = true;
  }
  return any;
}

bool StubRegister::reopen(int stub, std::string evidence, std::int64_t utime) {
  if (find(stub) == nullptr || !holds_[static_cast<std::size_t>(stub)].final) return false;
  const auto i = static_cast<std::size_t>(stub);
  holds_[i].final = false;
  holds_[i].stalls = 0;
  holds_[i].closings = 0;
  holds_[i].least_way_m = StubHold::kNever;
  if (stubs_[i].state != StubState::kExplored) {
    set(stubs_[i], StubState::kOpen, std::move(evidence), utime);
  }
  return true;
}

void StubRegister::set_within_budget(int stub, bool within, const std::string& evidence,
                                     std::int64_t utime) {
  if (find(stub) == nullptr) return;
  Stub& which = stubs_[static_cast<std::size_t>(stub)];
  if (!is_to_visit(which.state)) return;
  set(which, within ? StubState::kOpen : StubState::kBeyondBudget, within ? "" : evidence, utime);
}

std::vector<RememberedStub> StubRegister::remembered() const {
  std::vector<RememberedStub> stubs;
  for (std::size_t i = 0; i < stubs_.size(); ++i) stubs.push_back({stubs_[i], holds_[i]});
  return stubs;
}

void StubRegister::restore(const std::vector<RememberedStub>& stubs) {
  stubs_.clear();
  holds_.clear();
  for (const auto& [stub, hold] : stubs) {
    stubs_.push_back(stub);
    holds_.push_back(hold);
  }
  closings_.assign(stubs_.size(), {});
}

const Stub* StubRegister::find(int stub) const {
  const bool known = stub >= 0 && stub < static_cast<int>(stubs_.size());
  return known ? &stubs_[static_cast<std::size_t>(stub)] : nullptr;
}

}  // namespace adit
