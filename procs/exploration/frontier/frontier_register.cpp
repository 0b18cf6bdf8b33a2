// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/frontier/frontier_register.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace adit {
namespace {

constexpr double kNearerM = 1.0;              // less is none
constexpr double kShiftM = 0.5;               // by which maps may move against each other
const double kAdvanceCosine = std::cos(1.0);  // of the angle by which a corridor may bend

void set(Frontier& frontier, FrontierState state, std::string evidence, std::int64_t utime) {
  if (frontier.state == state) return;
  frontier.state = state;
  frontier.evidence = std::move(evidence);
  frontier.utime = utime;
}

bool lies_ahead(const Frontier& frontier, const Eigen::Vector2d& p_map) {
  const Eigen::Vector2d offset = p_map - frontier.p_map;
  return offset.dot(frontier.direction_map) > kAdvanceCosine * offset.norm();
}

std::string observed_by(std::optional<int> local_map) {
  if (!local_map) return "what lies there was seen";
  return "what lies there was seen by local map " + std::to_string(*local_map);
}

}  // namespace

void FrontierRegister::update(const std::vector<DetectedFrontier>& ends, const KnownSpace& space,
                              const std::vector<BarrierEvidence>& barriers, std::int64_t utime) {
  move_with_the_graph(space);
  std::vector<bool> found(frontiers_.size());
  std::vector<bool> matched(ends.size());
  for (const Search search : {Search::kHere, Search::kOnward, Search::kReopened}) {
    match(ends, space, search, found, matched);
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!found[i] && !tracks_[i].final) close(i, space, utime);
  }
  for (std::size_t k = 0; k < ends.size(); ++k) {
    if (matched[k]) continue;
    Frontier frontier;
    frontier.id = static_cast<int>(frontiers_.size());
    frontier.utime = utime;
    frontiers_.push_back(frontier);
    tracks_.emplace_back();
    closings_.emplace_back();
    place(frontiers_.size() - 1, ends[k], space);
    judge(frontiers_.size() - 1, ends[k].access, barriers, utime);
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!found[i]) continue;
    const auto end = std::find_if(ends.begin(), ends.end(), [&](const DetectedFrontier& candidate) {
      return candidate.p_map == frontiers_[i].p_map;
    });
    judge(i, end->access, barriers, utime);
  }
  confirm_closed(ends, space);
}

void FrontierRegister::move_with_the_graph(const KnownSpace& space) {
  for (std::size_t i = 0; i < frontiers_.size(); ++i) {
    Frontier& frontier = frontiers_[i];
    const auto T_map_local = space.pose_of(frontier.local_map);
    if (!T_map_local) continue;
    frontier.p_map = *T_map_local * tracks_[i].p_local;
    frontier.direction_map = *T_map_local * tracks_[i].direction_local - T_map_local->translation();
  }
}

bool FrontierRegister::may_match(std::size_t i, const DetectedFrontier& end, Search search) const {
  const bool explored = frontiers_[i].state == FrontierState::kExplored;
  if (explored != (search == Search::kReopened)) return false;
  const double distance = (end.p_map - frontiers_[i].p_map).norm();
  if (search != Search::kOnward) return distance <= params_.match_m;
  return !tracks_[i].final && distance <= params_.advance_m && lies_ahead(frontiers_[i], end.p_map);
}

/// Nearest pairs first.
void FrontierRegister::match(const std::vector<DetectedFrontier>& ends, const KnownSpace& space,
                             Search search, std::vector<bool>& found, std::vector<bool>& matched) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (std::size_t k = 0; k < ends.size(); ++k) {
      if (found[i] || matched[k] || !may_match(i, ends[k], search)) continue;
      pairs.push_back({(ends[k].p_map - frontiers_[i].p_map).norm(), i, k});
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return std::tie(a.distance_m, a.frontier, a.end) < std::tie(b.distance_m, b.frontier, b.end);
  });
  for (const Pair& pair : pairs) {
    if (found[pair.frontier] || matched[pair.end]) continue;
    matched[pair.end] = true;
    if (search == Search::kReopened && is_seam(pair.frontier, ends[pair.end], space)) continue;
    found[pair.frontier] = true;
    place(pair.frontier, ends[pair.end], space);
  }
}

/// What lies there was seen; after so many times, for good.
void FrontierRegister::close(std::size_t i, const KnownSpace& space, std::int64_t utime) {
  if (frontiers_[i].state == FrontierState::kExplored) return;
  const std::optional<int> newest = space.newest();
  set(frontiers_[i], FrontierState::kExplored, observed_by(newest), utime);
  tracks_[i].final = ++tracks_[i].closings >= params_.closings;
  if (!newest) return;
  closings_[i] = {newest, space.pose_of(*newest)->inverse() * frontiers_[i].p_map, *newest};
}

/// It was seen to be closed, nobody has seen the place since nothing was open there, and who saw it
/// lies as he did.
bool FrontierRegister::is_seam(std::size_t i, const DetectedFrontier& end,
                               const KnownSpace& space) const {
  const Closing& closing = closings_[i];
  if (!closing.local_map || space.newest_at(end.p_map).value_or(0) > closing.up_to) return false;
  const auto T_map_local = space.pose_of(*closing.local_map);
  return T_map_local && (*T_map_local * closing.p_local - frontiers_[i].p_map).norm() <= kShiftM;
}

void FrontierRegister::confirm_closed(const std::vector<DetectedFrontier>& ends,
                                      const KnownSpace& space) {
  for (std::size_t i = 0; i < frontiers_.size(); ++i) {
    const bool open = std::ranges::any_of(ends, [&](const DetectedFrontier& end) {
      return (end.p_map - frontiers_[i].p_map).norm() <= params_.match_m;
    });
    if (frontiers_[i].state == FrontierState::kExplored && !open) {
      closings_[i].up_to = space.newest().value_or(0);
    }
  }
}

void FrontierRegister::place(std::size_t i, const DetectedFrontier& end, const KnownSpace& space) {
  Frontier& frontier = frontiers_[i];
  frontier.p_map = end.p_map;
  frontier.direction_map = end.direction_map;
  frontier.width_m = end.width_m;
  frontier.local_map = space.tile_at(end.p_map).value_or(space.newest().value_or(0));
  const Pose2 T_local_map = space.pose_of(frontier.local_map).value_or(Pose2{}).inverse();
  tracks_[i].p_local = T_local_map * end.p_map;
  tracks_[i].direction_local = T_local_map * end.direction_map - T_local_map.translation();
}

void FrontierRegister::judge(std::size_t i, Access access,
                             const std::vector<BarrierEvidence>& barriers, std::int64_t utime) {
  Frontier& frontier = frontiers_[i];
  if (tracks_[i].final) return;
  if (access == Access::kReachable) {
    if (frontier.state != FrontierState::kBeyondBudget)
      set(frontier, FrontierState::kOpen, {}, utime);
    return;
  }
  if (access == Access::kBehindBarrier && !barriers.empty()) {
    const auto nearest = std::min_element(
        barriers.begin(), barriers.end(), [&](const BarrierEvidence& a, const BarrierEvidence& b) {
          return (a.p_map - frontier.p_map).norm() < (b.p_map - frontier.p_map).norm();
        });
    return set(frontier, nearest->state, nearest->evidence, utime);
  }
  set(frontier, FrontierState::kTooNarrow, "no known way there is wide enough for the vehicle",
      utime);
}

/// From wherever the robot is now; what stalled before is remembered until it comes nearer.
void FrontierRegister::begin_pursuit(int frontier) {
  if (find(frontier) != nullptr)
    tracks_[static_cast<std::size_t>(frontier)].path_length_min_m = FrontierTrack::kNever;
}

void FrontierRegister::record_pursuit(int frontier, double path_length_m, int local_map,
                                      std::int64_t utime) {
  if (find(frontier) == nullptr) return;
  Frontier& target = frontiers_[static_cast<std::size_t>(frontier)];
  FrontierTrack& track = tracks_[static_cast<std::size_t>(frontier)];
  if (target.state != FrontierState::kOpen) return;
  const bool moved = (target.p_map - track.p_map_at_min).norm() > params_.match_m;
  if (moved || path_length_m < track.path_length_min_m - kNearerM) {
    if (track.path_length_min_m < FrontierTrack::kNever) track.stalls = 0;
    track.path_length_min_m = path_length_m;
    track.p_map_at_min = target.p_map;
    return;
  }
  if (++track.stalls < params_.stalls) return;
  track.final = true;
  set(target, FrontierState::kUnobservable,
      "up to local map " + std::to_string(local_map) + ", " + std::to_string(track.stalls) +
          " in a row came no nearer and saw nothing of it",
      utime);
}

bool FrontierRegister::block(int frontier, bool unconfirmed, std::string evidence,
                             std::int64_t utime) {
  if (find(frontier) == nullptr || find(frontier)->state == FrontierState::kExplored) return false;
  const auto i = static_cast<std::size_t>(frontier);
  tracks_[i].final = true;
  const FrontierState state = unconfirmed ? FrontierState::kUnconfirmed : FrontierState::kBlocked;
  set(frontiers_[i], state, std::move(evidence), utime);
  return true;
}

bool FrontierRegister::retry_abandoned(std::int64_t utime) {
  bool any = false;
  for (std::size_t i = 0; i < frontiers_.size(); ++i) {
    const bool abandoned = is_abandoned(frontiers_[i].state);
    const bool presumed = frontiers_[i].state == FrontierState::kBlocked && !tracks_[i].final;
    if (tracks_[i].retried || (!abandoned && !presumed)) continue;
    if (abandoned) reopen(frontiers_[i].id, "it was given up, and is tried once more", utime);
    any = tracks_[i].retried = true;
  }
  return any;
}

bool FrontierRegister::reopen(int frontier, std::string evidence, std::int64_t utime) {
  if (find(frontier) == nullptr || !tracks_[static_cast<std::size_t>(frontier)].final) return false;
  const auto i = static_cast<std::size_t>(frontier);
  tracks_[i].final = false;
  tracks_[i].stalls = 0;
  tracks_[i].closings = 0;
  tracks_[i].path_length_min_m = FrontierTrack::kNever;
  if (frontiers_[i].state != FrontierState::kExplored) {
    set(frontiers_[i], FrontierState::kOpen, std::move(evidence), utime);
  }
  return true;
}

void FrontierRegister::set_within_budget(int frontier, bool within, const std::string& evidence,
                                         std::int64_t utime) {
  if (find(frontier) == nullptr) return;
  Frontier& which = frontiers_[static_cast<std::size_t>(frontier)];
  if (!is_visitable(which.state)) return;
  set(which, within ? FrontierState::kOpen : FrontierState::kBeyondBudget, within ? "" : evidence,
      utime);
}

std::vector<StoredFrontier> FrontierRegister::stored_frontiers() const {
  std::vector<StoredFrontier> frontiers;
  for (std::size_t i = 0; i < frontiers_.size(); ++i)
    frontiers.push_back({frontiers_[i], tracks_[i]});
  return frontiers;
}

void FrontierRegister::restore(const std::vector<StoredFrontier>& frontiers) {
  frontiers_.clear();
  tracks_.clear();
  for (const auto& [frontier, track] : frontiers) {
    frontiers_.push_back(frontier);
    tracks_.push_back(track);
  }
  closings_.assign(frontiers_.size(), {});
}

const Frontier* FrontierRegister::find(int frontier) const {
  const bool known = frontier >= 0 && frontier < static_cast<int>(frontiers_.size());
  return known ? &frontiers_[static_cast<std::size_t>(frontier)] : nullptr;
}

}  // namespace adit
