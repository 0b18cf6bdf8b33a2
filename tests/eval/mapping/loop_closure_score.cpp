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
constexpr double kCoincidentM = 5.0;  // between two poses that see the same place
constexpr double kSharpM = 0.03;      // as far as a pose between two scans may be from either
constexpr double kSharpRad = 0.02;

using Pair = std::pair<int, int>;  // older, newer

/// Is the pose at a time hardly other than at the nearest scan?
bool is_sharp(const Trajectory& odometry, std::int64_t utime) {
  const auto T_odom_body = interpolate(odometry, utime);
  if (!T_odom_body) return false;
  auto after = std::lower_bound(odometry.begin(), odometry.end(), utime,
                                [](const TimedPose& p, std::int64_t t) { return p.utime < t; });
  if (after == odometry.end()) --after;
  if (after != odometry.begin() && utime - (after - 1)->utime < after->utime - utime) --after;
  const Pose2 off = between(after->pose, *T_odom_body);
  return off.translation().norm() < kSharpM && std::abs(off.theta) < kSharpRad;
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

/// What relations say of pairs of maps.
struct Links {
  std::map<Pair, std::vector<Pose2>> T_older_newer;
  std::map<Pair, bool> coincident;  ///< whether one of them has its poses near each other
};

Links links_of(const StoredMap& map, const Trajectory& odometry,
               const std::vector<Relation>& relations) {
  Links links;
  for (const Relation& relation : relations) {
    const auto first = map_at(map, relation.utime_1);
    const auto second = map_at(map, relation.utime_2);
    if (!first || !second || std::abs(*first - *second) < 2) continue;
    if (!is_sharp(odometry, relation.utime_1) || !is_sharp(odometry, relation.utime_2)) continue;
    const Pose2 T_first_second = T_local_body(map, *first, odometry, relation.utime_1) *
                                 relation.T_1_2 *
                                 T_local_body(map, *second, odometry, relation.utime_2).inverse();
    const bool in_order = *first < *second;
    const Pair pair = std::minmax(*first, *second);
    links.T_older_newer[pair].push_back(in_order ? T_first_second : T_first_second.inverse());
    links.coincident[pair] |= relation.T_1_2.translation().norm() <= kCoincidentM;
  }
  return links;
}

std::multimap<Pair, Pose2> loop_closures_in_force(const StoredMap& map) {
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
        const Pose2 off = between(relation, T_older_newer);
        return off.translation().norm() <= kRightM && rad_to_deg(std::abs(off.theta)) <= kRightDeg;
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
  const auto loop_closures = loop_closures_in_force(map);
  LoopClosureScore score;
  score.in_force = loop_closures.size();
  for (const auto& [pair, T_older_newer] : loop_closures) {
    const auto link = links.T_older_newer.find(pair);
    if (link == links.T_older_newer.end()) continue;
    ++score.evaluated;
    score.right += is_right(T_older_newer, link->second) ? 1 : 0;
  }
  for (const auto& [pair, coincident] : links.coincident) {
    if (!coincident) continue;
    ++score.expected;
    score.found += is_found(pair, loop_closures) ? 1 : 0;
  }
  return score;
}

}  // namespace adit
