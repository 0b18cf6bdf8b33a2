// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/eval/mapping/loop_closure_score.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

namespace adit {
namespace {

constexpr double kRightM = 0.5;
constexpr double kRightDeg = 5.0;
constexpr double kOverlapM = 5.0;  // largest distance of two poses with overlapping scans
constexpr double kInterpolationM =
    0.03;  // largest distance of an interpolated pose from that of the scan
constexpr double kInterpolationRad = 0.02;

using Pair = std::pair<int, int>;  // older, newer

/// Whether the interpolated pose at a time is close to the pose of the nearest scan.
bool is_accurate(const Trajectory& odometry, std::int64_t utime) {
  const auto T_odom_body = interpolate(odometry, utime);
  if (!T_odom_body) return false;
  auto after = std::lower_bound(odometry.begin(), odometry.end(), utime,
                                [](const TimedPose& p, std::int64_t t) { return p.utime < t; });
  if (after == odometry.end()) --after;
  if (after != odometry.begin() && utime - (after - 1)->utime < after->utime - utime) --after;
  const Pose2 difference = between(after->pose, *T_odom_body);
  return difference.translation().norm() < kInterpolationM &&
         std::abs(difference.theta) < kInterpolationRad;
}

std::optional<int> map_at(const StoredMap& map, std::int64_t utime) {
  const auto found = std::find_if(map.maps.begin(), map.maps.end(), [&](const LocalMap& m) {
    return utime >= m.utime && utime <= m.end_utime;
  });
  if (found == map.maps.end()) return std::nullopt;
  return found->id;
}

Pose2 T_local_body(const StoredMap& map, int id, const Trajectory& odometry, std::int64_t utime) {
  return between(map.maps[static_cast<std::size_t>(id)].T_odom_local,
                 *interpolate(odometry, utime));
}

/// Pairs of local maps that relations link.
struct Links {
  std::map<Pair, std::vector<Pose2>> T_older_newer;
  std::map<Pair, bool> overlapping;  ///< whether a relation is within kOverlapM
};

Links links_of(const StoredMap& map, const Trajectory& odometry,
               const std::vector<Relation>& relations) {
  Links links;
  for (const Relation& relation : relations) {
    const auto first = map_at(map, relation.utime_1);
    const auto second = map_at(map, relation.utime_2);
    if (!first || !second || std::abs(*first - *second) < 2) continue;
    if (!is_accurate(odometry, relation.utime_1) || !is_accurate(odometry, relation.utime_2))
      continue;
    const Pose2 T_first_second = T_local_body(map, *first, odometry, relation.utime_1) *
                                 relation.T_1_2 *
                                 T_local_body(map, *second, odometry, relation.utime_2).inverse();
    const bool in_order = *first < *second;
    const Pair pair = std::minmax(*first, *second);
    links.T_older_newer[pair].push_back(in_order ? T_first_second : T_first_second.inverse());
    links.overlapping[pair] |= relation.T_1_2.translation().norm() <= kOverlapM;
  }
  return links;
}

std::multimap<Pair, Pose2> accepted_loop_closures(const StoredMap& map) {
  std::map<int, const Association*> last;
  for (const Association& association : map.associations) {
    last[association.loop_closure.id] = &association;
  }
  std::multimap<Pair, Pose2> loop_closures;
  for (const auto& [id, association] : last) {
    if (association->chosen == Association::kNone) continue;
    const auto& chosen =
        association->loop_closure.alternatives[static_cast<std::size_t>(association->chosen)];
    loop_closures.emplace(Pair{chosen.older_map, association->loop_closure.newer_map},
                          chosen.T_older_newer);
  }
  return loop_closures;
}

bool is_right(const Pose2& T_older_newer, const std::vector<Pose2>& relations) {
  const auto agreeing =
      std::count_if(relations.begin(), relations.end(), [&](const Pose2& relation) {
        const Pose2 error = between(relation, T_older_newer);
        return error.translation().norm() <= kRightM &&
               rad_to_deg(std::abs(error.theta)) <= kRightDeg;
      });
  return 2 * static_cast<std::size_t>(agreeing) >= relations.size();
}

bool is_found(const Pair& pair, const std::multimap<Pair, Pose2>& loop_closures) {
  return std::any_of(loop_closures.begin(), loop_closures.end(), [&](const auto& loop_closure) {
    return std::abs(loop_closure.first.first - pair.first) <= 1 &&
           std::abs(loop_closure.first.second - pair.second) <= 1;
  });
}

}  // namespace

LoopClosureScore score_loop_closures(const StoredMap& map, const Trajectory& odometry,
                                     const std::vector<Relation>& relations) {
  const Links links = links_of(map, odometry, relations);
  const auto loop_closures = accepted_loop_closures(map);
  LoopClosureScore score;
  score.accepted = loop_closures.size();
  for (const auto& [pair, T_older_newer] : loop_closures) {
    const auto link = links.T_older_newer.find(pair);
    if (link == links.T_older_newer.end()) continue;
    ++score.evaluated;
    score.right += is_right(T_older_newer, link->second) ? 1 : 0;
  }
  for (const auto& [pair, overlapping] : links.overlapping) {
    if (!overlapping) continue;
    ++score.expected;
    score.found += is_found(pair, loop_closures) ? 1 : 0;
  }
  return score;
}

}  // namespace adit
