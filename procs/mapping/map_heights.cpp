// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/map_heights.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace adit {
namespace {

constexpr double kSigmas = 3.0;
constexpr double kUnknownM = 1000.0;
constexpr double kAtRestM = 0.001;
constexpr double kSettlesM = 0.5;  // distance over which a body rises and sinks on rough ground

/// Where two paths are nearest to each other in plan.
struct Approach {
  double distance_m = std::numeric_limits<double>::infinity();
  double rise_m = 0.0;  ///< of the second path above the first, each in its local map
};

Approach approach(const std::vector<TraversedPoint>& path, const Pose2& T_path_other,
                  const std::vector<TraversedPoint>& other) {
  Approach nearest;
  for (const auto& [q, q_forward_m] : other) {
    const Eigen::Vector2d there = T_path_other * Eigen::Vector2d(q.head<2>());
    for (const auto& [p, p_forward_m] : path) {
      const double distance_m = (p.head<2>() - there).norm();
      if (distance_m < nearest.distance_m) nearest = {distance_m, q.z() - p.z()};
    }
  }
  return nearest;
}

}  // namespace

/// A session begins at an unknown place: the slope bounds the climb from the end of the last one.
HeightConstraint MapHeights::climb_of(const LocalMap& map, const LocalMap& before) const {
  HeightConstraint climb{
      node_of(map.id - 1), node_of(map.id), map.climb_m, 0.0, {{{before.session, map.forward_m}}}};
  if (map.session != before.session) {
    const double sd_m = 1.0 / std::sqrt(std::max(map.information(0, 0), 1e-12));
    const double length_m = map.T_previous_local.translation().norm();
    climb.sd_m = std::min(kUnknownM, params_.slope_max * (sd_m + length_m) + params_.floor_m);
    return climb;
  }
  const double length_m =
      std::max(std::abs(map.forward_m), map.T_previous_local.translation().norm());
  climb.sd_m = std::hypot(params_.floor_m, drift_per_m(before) * length_m);
  return climb;
}

double MapHeights::drift_per_m(const LocalMap& map) const {
  if (map.scans.empty() || !map.scans.back().attitude) return params_.slope_max;
  return map.scans.back().attitude_from_ground ? params_.ground_drift_per_m : params_.drift_per_m;
}

const GroundOffset& MapHeights::offset_at(const PoseConstraint& loop_closure,
                                          const WallStore& walls) {
  const auto [entry, is_new] = offsets_.try_emplace({loop_closure.from, loop_closure.to});
  Offset& offset = entry->second;
  if (is_new || offset.T_from_to != loop_closure.T_from_to) {
    offset = {
        loop_closure.T_from_to,
        ground_offset(walls.path(static_cast<std::size_t>(loop_closure.to)), loop_closure.T_from_to,
                      walls.path(static_cast<std::size_t>(loop_closure.from)))};
  }
  return offset.ground;
}

void MapHeights::add_new(const std::vector<LocalMap>& maps) {
  add_climbs(maps);
  field_.update();
}

void MapHeights::add_climbs(const std::vector<LocalMap>& maps) {
  for (std::size_t i = maps_.size(); i < maps.size(); ++i) {
    maps_.emplace_back();
    if (i > 0) {
      maps_.back().node = field_.add_node();
      maps_.back().constraint = field_.add(climb_of(maps[i], maps[i - 1]));
    }
    add_scans(maps[i]);
  }
}

void MapHeights::add_scans(const LocalMap& map) {
  const auto of_map = scans_.find(map.id);
  if (of_map == scans_.end()) return;
  for (Scan& scan : of_map->second) {
    const CloudPlace& place = scan.place;
    const int node = field_.add_node();
    const int constraint = field_.add({node_of(map.id),
                                       node,
                                       place.z_m,
                                       scan_sd_m(map, place),
                                       {{{map.session, place.forward_m}}}});
    scan.node = {node, constraint};
  }
}

/// The body sinks and rises within its own length: where it has not moved it has not either.
double MapHeights::scan_sd_m(const LocalMap& map, const CloudPlace& place) const {
  const double moved_m = std::abs(place.forward_m);
  return std::hypot(kAtRestM, params_.scan_m * std::min(1.0, moved_m / kSettlesM),
                    drift_per_m(map) * moved_m);
}

/// With its 3D scans, which are later nodes of the field.
void MapHeights::remove_newest_map() {
  const int map = static_cast<int>(maps_.size()) - 1;
  for (std::vector<Scan>& scans = scans_[map]; !scans.empty(); scans.pop_back()) {
    field_.remove(scans.back().node->constraint);
    field_.remove_newest_node();
  }
  scans_.erase(map);
  matches_.erase(map);
  if (map > 0) {
    field_.remove(maps_.back().constraint);
    field_.remove_newest_node();
  }
  maps_.pop_back();
}

void MapHeights::add(const CloudPlace& place) {
  std::vector<Scan>& scans = scans_[place.map];
  if (std::ranges::find(scans, place, &Scan::place) == scans.end()) scans.push_back({place, {}});
}

void MapHeights::add(const CloudMatch& match) {
  add(match.older);
  add(match.newer);
  matches_[match.newer.map].push_back(match);
}

const std::vector<CloudMatch>& MapHeights::matches_of(int newer_map) const {
  static const std::vector<CloudMatch> none;
  const auto entry = matches_.find(newer_map);
  return entry == matches_.end() ? none : entry->second;
}

const CloudMatch* MapHeights::match_of(const PoseConstraint& loop_closure) const {
  const std::vector<CloudMatch>& matches = matches_of(loop_closure.to);
  const auto match = std::ranges::find_if(matches, [&](const CloudMatch& m) {
    return m.older.map == loop_closure.from && m.T_older_newer == loop_closure.T_from_to;
  });
  return match == matches.end() ? nullptr : &*match;
}

std::optional<int> MapHeights::node_of(const CloudPlace& place) const {
  const auto of_map = scans_.find(place.map);
  if (of_map == scans_.end()) return std::nullopt;
  const auto scan = std::ranges::find(of_map->second, place, &Scan::place);
  if (scan == of_map->second.end() || !scan->node) return std::nullopt;
  return scan->node->node;
}

Eigen::VectorXd MapHeights::variances_to(int map) const {
  Eigen::VectorXd variances(static_cast<Eigen::Index>(maps_.size()));
  for (int i = 0; i < static_cast<int>(maps_.size()); ++i) variances[i] = variance(i, map);
  return variances;
}

void MapHeights::update(const std::vector<LocalMap>& maps, const WallStore& walls,
                        const std::vector<PoseConstraint>& loop_closures) {
  const auto is_same = [](const LoopClosureInForce& before, const PoseConstraint& now) {
    return before.from == now.from && before.to == now.to && before.T_from_to == now.T_from_to;
  };
  const auto kept = static_cast<std::size_t>(
      std::ranges::mismatch(loop_closures_, loop_closures, is_same).in1 - loop_closures_.begin());
  for (; loop_closures_.size() > kept; loop_closures_.pop_back()) {
    if (loop_closures_.back().constraint >= 0) field_.remove(loop_closures_.back().constraint);
  }
  while (maps_.size() > maps.size()) remove_newest_map();
  add_climbs(maps);
  for (std::size_t k = kept; k < loop_closures.size(); ++k) {
    const PoseConstraint& c = loop_closures[k];
    loop_closures_.push_back({c.from, c.to, c.T_from_to, add_to_field(c, maps, walls)});
  }
  field_.update();
}

/// The 3D scans are one above the other by what both see; −1 if one of them is not in the field.
int MapHeights::add_to_field(const CloudMatch& match, int session) {
  const auto older = node_of(match.older);
  const auto newer = node_of(match.newer);
  if (!older || !newer) return -1;
  return field_.add({*older,
                     *newer,
                     match.rise_m,
                     match.rise_sd_m,
                     {{{session, match.lever_m.x(), match.lever_m.y()}}}});
}

/// Ties the 3D scans that were matched, otherwise the ground of both local maps; −1 if they have
/// none in common.
int MapHeights::add_to_field(const PoseConstraint& loop_closure, const std::vector<LocalMap>& maps,
                             const WallStore& walls) {
  if (const CloudMatch* const match = match_of(loop_closure)) {
    return add_to_field(*match, maps[static_cast<std::size_t>(loop_closure.from)].session);
  }
  const GroundOffset& ground = offset_at(loop_closure, walls);
  if (!std::isfinite(ground.offset_m)) return -1;
  const double sd_m = std::hypot(params_.ground_sd_m, params_.ground_slope * ground.distance_m);
  const int from_session = maps[static_cast<std::size_t>(loop_closure.from)].session;
  const int to_session = maps[static_cast<std::size_t>(loop_closure.to)].session;
  return field_.add(
      {node_of(loop_closure.from),
       node_of(loop_closure.to),
       ground.offset_m,
       sd_m,
       {{{from_session, ground.reference_forward_m}, {to_session, -ground.path_forward_m}}}});
}

bool MapHeights::same_level(int older, int newer, const Pose2& T_older_newer,
                            const WallStore& walls) const {
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  const Approach nearest = approach(walls.path(at(older)), T_older_newer, walls.path(at(newer)));
  const double rise_m = height_m(newer) - height_m(older) + nearest.rise_m;
  const double allowed_m = params_.level_m + params_.slope_max * nearest.distance_m +
                           kSigmas * std::sqrt(variance(older, newer));
  return std::abs(rise_m) <= allowed_m;
}

}  // namespace adit
