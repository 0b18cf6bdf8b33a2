// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/loop_closure/contradiction_monitor.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace adit {
namespace {

// A change of the relative pose that may matter, against the margin of 0.3 m in free space.
constexpr double kMovedM = 0.1;
constexpr double kMovedRad = 0.02;

constexpr double kOneHeightM = 0.5;

constexpr std::size_t kComparedMax = 24;  // older maps

/// Whether all walls were observed at about one height.
bool is_level(const LocalWalls& walls) {
  const auto [lowest, highest] = std::ranges::minmax_element(walls.points, {}, &SurfacePoint::z_m);
  return lowest == walls.points.end() || highest->z_m - lowest->z_m < kOneHeightM;
}

bool has_moved(const Pose2& before, const Pose2& now, double share) {
  const Pose2 by = between(before, now);
  return by.translation().norm() > share * kMovedM || std::abs(by.theta) > share * kMovedRad;
}

std::array<float, 3> floats_of(const Pose2& T) {
  return {static_cast<float>(T.x), static_cast<float>(T.y), static_cast<float>(T.theta)};
}

Pose2 pose_of(const std::array<float, 3>& T) { return {T[0], T[1], T[2]}; }

bool may_overlap(const MapExtent& older, const MapExtent& newer, const Pose2& T_older_newer) {
  const double apart = (T_older_newer * newer.centre() - older.centre()).norm();
  return apart < older.radius_m() + newer.radius_m();
}

}  // namespace

void ContradictionMonitor::update(const WallStore& walls, std::span<const MapExtent> extents,
                                  std::span<const Pose2> T_map_local,
                                  const WallsAround& walls_around, const SameLevel& same_level) {
  std::vector<bool> moved(T_map_local.size(), true);
  for (std::size_t i = 0; i < compared_at_.size(); ++i) {
    moved[i] = compared_at_[i] != T_map_local[i] && has_moved(compared_at_[i], T_map_local[i], 0.5);
  }
  compared_at_.resize(T_map_local.size());
  compared_.resize(T_map_local.size());
  for (std::size_t i = is_level_.size(); i < walls.size(); ++i) {
    is_level_.push_back(is_level(*walls[i]));
  }
  std::vector<std::size_t> all_ids;
  std::vector<std::size_t> moved_ids;
  for (std::size_t i = 0; i < T_map_local.size(); ++i) {
    if (!is_level_[i]) continue;
    all_ids.push_back(i);
    if (moved[i]) moved_ids.push_back(i);
  }
  for (const std::size_t newer : all_ids) {
    const std::vector<std::size_t> pairs = moved[newer]
                                               ? nearest_older(newer, all_ids, extents, T_map_local)
                                               : moved_older(newer, moved_ids);
    for (const std::size_t older : pairs) {
      compare(older, newer, walls, extents, between(T_map_local[older], T_map_local[newer]),
              walls_around);
    }
  }
  for (std::size_t i = 0; i < moved.size(); ++i) {
    if (moved[i]) compared_at_[i] = T_map_local[i];
  }
  contradictions_.clear();
  for (const auto& [key, suspicion] : suspected_) {
    const auto [newer, older] = key;
    if (!same_level(older, newer, suspicion.T_older_newer)) continue;
    contradictions_.push_back({older, newer, suspicion.evidence});
  }
}

/// Those that may overlap, nearest first, at most kComparedMax: where a place was passed more
/// often, the others say the same. Forgets the comparisons with all others.
std::vector<std::size_t> ContradictionMonitor::nearest_older(std::size_t newer,
                                                             std::span<const std::size_t> all,
                                                             std::span<const MapExtent> extents,
                                                             std::span<const Pose2> T_map_local) {
  std::vector<std::pair<double, std::size_t>> by_distance;
  for (const std::size_t older : all) {
    if (older >= newer) break;
    const double reach_m = extents[older].reach_m() + extents[newer].reach_m();
    const Eigen::Vector2d apart =
        T_map_local[older].translation() - T_map_local[newer].translation();
    if (apart.squaredNorm() > reach_m * reach_m) continue;
    const Pose2 T_older_newer = between(T_map_local[older], T_map_local[newer]);
    if (may_overlap(extents[older], extents[newer], T_older_newer))
      by_distance.emplace_back(apart.norm(), older);
  }
  const std::size_t count = std::min(by_distance.size(), kComparedMax);
  std::partial_sort(by_distance.begin(), by_distance.begin() + static_cast<std::ptrdiff_t>(count),
                    by_distance.end());
  by_distance.resize(count);
  std::vector<std::size_t> nearest;
  for (const auto& [distance_m, older] : by_distance) nearest.push_back(older);
  std::ranges::sort(nearest);
  std::erase_if(compared_[newer], [&](const Compared& pair) {
    const bool is_kept = std::ranges::binary_search(nearest, static_cast<std::size_t>(pair.older));
    if (!is_kept) suspected_.erase({static_cast<int>(newer), pair.older});
    return !is_kept;
  });
  return nearest;
}

/// Those that have moved: all that were compared, and others while there are few.
std::vector<std::size_t> ContradictionMonitor::moved_older(
    std::size_t newer, std::span<const std::size_t> moved) const {
  const std::vector<Compared>& compared = compared_[newer];
  std::vector<std::size_t> older;
  for (const std::size_t map : moved) {
    if (map >= newer) break;
    const bool is_known =
        std::ranges::binary_search(compared, static_cast<std::int32_t>(map), {}, &Compared::older);
    if (is_known || compared.size() < kComparedMax) older.push_back(map);
  }
  return older;
}

void ContradictionMonitor::compare(std::size_t older, std::size_t newer, const WallStore& walls,
                                   std::span<const MapExtent> extents, const Pose2& T_older_newer,
                                   const WallsAround& walls_around) {
  const std::pair<int, int> key(static_cast<int>(newer), static_cast<int>(older));
  std::vector<Compared>& all = compared_[newer];
  auto found = std::ranges::lower_bound(all, key.second, {}, &Compared::older);
  const bool is_new = found == all.end() || found->older != key.second;
  if (!may_overlap(extents[older], extents[newer], T_older_newer)) {
    if (!is_new) all.erase(found);
    suspected_.erase(key);
    return;
  }
  if (!is_new && !has_moved(pose_of(found->T_older_newer), T_older_newer, 1.0)) return;
  if (is_new) found = all.insert(found, {key.second, {}});
  found->T_older_newer = floats_of(T_older_newer);
  suspected_.erase(key);
  const auto newer_walls = walls[newer];
  const double bound = contradiction_bound(*newer_walls, *walls[older], T_older_newer, params_);
  if (bound < evidence_min_) return;
  const double found_evidence =
      evidence(walls_around(static_cast<int>(older)), *newer_walls, T_older_newer);
  if (found_evidence >= evidence_min_) suspected_[key] = {T_older_newer, found_evidence};
}

/// Of both the older map alone and with its neighbours, in whose walls and free space it continues.
double ContradictionMonitor::evidence(std::vector<PlacedWalls> older, const LocalWalls& newer,
                                      const Pose2& T_older_newer) const {
  const double alone = contradiction(newer, {older.front()}, T_older_newer, params_, evidence_min_);
  if (alone < evidence_min_) return alone;
  std::erase_if(older, [&](const PlacedWalls& placed) { return placed.walls.get() == &newer; });
  return std::min(alone, contradiction(newer, older, T_older_newer, params_, evidence_min_));
}

}  // namespace adit
