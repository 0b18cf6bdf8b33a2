// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/frontier/frontier_register.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace adit {
namespace {

constexpr double kNearerM = 1.0;  // less is no progress
constexpr double kPassedM = 2.0;  // distance at which level lasers see the end of a corridor surely
constexpr double kShiftM = 0.5;   // relative motion of local maps up to which they lie as before
const double kAdvanceCosine =
    std::cos(1.0);  // of the angle by which a corridor may bend between updates

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

}  // namespace

void FrontierRegister::update(const std::vector<DetectedFrontier>& detections,
                              const KnownSpace& space, const std::vector<BarrierEvidence>& barriers,
                              std::int64_t utime) {
  const std::optional<PosedTile> newest = space.newest();
  if (!newest) return;
  const PosedSpace posed{space, *newest};
  move_with_the_graph(space);
  std::vector<bool> found(frontiers_.size());
  std::vector<bool> matched(detections.size());
  for (const Search search : {Search::kHere, Search::kAhead, Search::kReopened}) {
    match(detections, posed, search, found, matched);
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!found[i] && !tracks_[i].final) close(i, posed, utime);
  }
  for (std::size_t k = 0; k < detections.size(); ++k) {
    if (matched[k]) continue;
    add(detections[k], posed, utime);
    set_state_by_access(frontiers_.size() - 1, detections[k].access, barriers, utime);
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!found[i]) continue;
    const auto detection = std::ranges::find_if(
        detections, [&](const DetectedFrontier& d) { return d.p_map == frontiers_[i].p_map; });
    set_state_by_access(i, detection->access, barriers, utime);
  }
  confirm_closed(detections, *newest);
}

void FrontierRegister::add(const DetectedFrontier& detection, const PosedSpace& posed,
                           std::int64_t utime) {
  Frontier frontier;
  frontier.id = static_cast<int>(frontiers_.size());
  frontier.utime = utime;
  frontiers_.push_back(frontier);
  tracks_.emplace_back();
  closings_.emplace_back();
  move_to(frontiers_.size() - 1, detection, posed);
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

bool FrontierRegister::may_match(std::size_t i, const DetectedFrontier& detection,
                                 Search search) const {
  const bool explored = frontiers_[i].state == FrontierState::kExplored;
  if (explored != (search == Search::kReopened)) return false;
  const double distance = (detection.p_map - frontiers_[i].p_map).norm();
  if (search != Search::kAhead) return distance <= params_.match_m;
  return !tracks_[i].final && distance <= params_.advance_m &&
         lies_ahead(frontiers_[i], detection.p_map);
}

/// Greedy assignment, nearest pairs first.
void FrontierRegister::match(const std::vector<DetectedFrontier>& detections,
                             const PosedSpace& posed, Search search, std::vector<bool>& found,
                             std::vector<bool>& matched) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (std::size_t k = 0; k < detections.size(); ++k) {
      if (found[i] || matched[k] || !may_match(i, detections[k], search)) continue;
      pairs.push_back({(detections[k].p_map - frontiers_[i].p_map).norm(), i, k});
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return std::tie(a.distance_m, a.frontier, a.detection) <
           std::tie(b.distance_m, b.frontier, b.detection);
  });
  for (const Pair& pair : pairs) {
    if (found[pair.frontier] || matched[pair.detection]) continue;
    const DetectedFrontier& detection = detections[pair.detection];
    matched[pair.detection] = true;
    const bool may_be_seam = search == Search::kReopened && !detection.at_dismissed_wall;
    if (may_be_seam && is_seam(pair.frontier, detection, posed.space)) continue;
    found[pair.frontier] = true;
    move_to(pair.frontier, detection, posed);
  }
}

/// The space behind it was observed. After `closings` times it is explored permanently. Where the
/// planner rejected it, level lasers may have taken rising ground or a roof for its end, until the
/// robot has passed it or 3D scans show rock there.
void FrontierRegister::close(std::size_t i, const PosedSpace& posed, std::int64_t utime) {
  if (frontiers_[i].state == FrontierState::kExplored) return;
  const PosedTile& newest = posed.newest;
  const bool was_rejected = tracks_[i].rejections >= params_.rejections;
  const auto is_decided = [&] {
    return posed.space.driven_distance_m(tracks_[i].p_map_rejected) <= kPassedM ||
           posed.space.shows_rock_ahead(frontiers_[i].p_map, frontiers_[i].direction_map);
  };
  if (was_rejected && !is_decided()) {
    return set(frontiers_[i], FrontierState::kUnconfirmed,
               fmt::format("{} plans found no path to it, and only level lasers show its end, in "
                           "local map {}",
                           tracks_[i].rejections, newest.id),
               utime);
  }
  set(frontiers_[i], FrontierState::kExplored,
      fmt::format("the space behind it was observed by local map {}", newest.id), utime);
  tracks_[i].final = ++tracks_[i].closings >= params_.closings;
  closings_[i] = {newest.id, newest.T_map_local.inverse() * frontiers_[i].p_map, newest.id};
}

void FrontierRegister::forget_closings() {
  for (std::size_t i = 0; i < frontiers_.size(); ++i) {
    if (frontiers_[i].state != FrontierState::kExplored) continue;
    tracks_[i].final = false;
    tracks_[i].closings = 0;
  }
}

/// The frontier was observed as closed, no local map has observed the place since then, and the one
/// that did has not moved relative to the frontier.
bool FrontierRegister::is_seam(std::size_t i, const DetectedFrontier& detection,
                               const KnownSpace& space) const {
  const Closing& closing = closings_[i];
  if (!closing.local_map) return false;
  const std::optional<int> observer = space.newest_at(detection.p_map);
  if (observer && *observer > closing.up_to) return false;
  const auto T_map_local = space.pose_of(*closing.local_map);
  return T_map_local && (*T_map_local * closing.p_local - frontiers_[i].p_map).norm() <= kShiftM;
}

void FrontierRegister::confirm_closed(const std::vector<DetectedFrontier>& detections,
                                      const PosedTile& newest) {
  for (std::size_t i = 0; i < frontiers_.size(); ++i) {
    const bool open = std::ranges::any_of(detections, [&](const DetectedFrontier& detection) {
      return (detection.p_map - frontiers_[i].p_map).norm() <= params_.match_m;
    });
    if (frontiers_[i].state == FrontierState::kExplored && !open) closings_[i].up_to = newest.id;
  }
}

/// Anchors the frontier to the local map that observed it, or to the newest one.
void FrontierRegister::move_to(std::size_t i, const DetectedFrontier& detection,
                               const PosedSpace& posed) {
  const PosedTile anchor = posed.space.tile_at(detection.p_map).value_or(posed.newest);
  const Pose2 T_local_map = anchor.T_map_local.inverse();
  Frontier& frontier = frontiers_[i];
  frontier.p_map = detection.p_map;
  frontier.direction_map = detection.direction_map;
  frontier.width_m = detection.width_m;
  frontier.local_map = anchor.id;
  tracks_[i].p_local = T_local_map * detection.p_map;
  tracks_[i].direction_local = T_local_map * detection.direction_map - T_local_map.translation();
}

void FrontierRegister::set_state_by_access(std::size_t i, Access access,
                                           const std::vector<BarrierEvidence>& barriers,
                                           std::int64_t utime) {
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
  if (frontier.width_m >= wide_m_) {
    return set(
        frontier, FrontierState::kUnconfirmed,
        fmt::format("no known path to it is wide enough for the vehicle, though it is {:.1f} "
                    "m wide",
                    frontier.width_m),
        utime);
  }
  set(frontier, FrontierState::kTooNarrow, "no known path to it is wide enough for the vehicle",
      utime);
}

/// Resets the least path length, as the robot may be anywhere. Stalls of earlier pursuits still
/// count until the robot comes nearer.
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
      fmt::format("{} local maps in a row, up to local map {}, came no nearer and observed nothing "
                  "behind it",
                  track.stalls, local_map),
      utime);
}

void FrontierRegister::record_rejection(int frontier) {
  if (find(frontier) == nullptr) return;
  FrontierTrack& track = tracks_[static_cast<std::size_t>(frontier)];
  if (track.rejections++ == 0) track.p_map_rejected = find(frontier)->p_map;
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
    if (abandoned) reopen(frontiers_[i].id, "it was abandoned before, and is retried once", utime);
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
  tracks_[i].rejections = 0;
  tracks_[i].path_length_min_m = FrontierTrack::kNever;
  if (frontiers_[i].state != FrontierState::kExplored) {
    set(frontiers_[i], FrontierState::kOpen, std::move(evidence), utime);
  }
  return true;
}

void FrontierRegister::set_within_budget(int frontier, bool within, const std::string& evidence,
                                         std::int64_t utime) {
  if (find(frontier) == nullptr) return;
  Frontier& target = frontiers_[static_cast<std::size_t>(frontier)];
  if (!is_visitable(target.state)) return;
  set(target, within ? FrontierState::kOpen : FrontierState::kBeyondBudget, within ? "" : evidence,
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
