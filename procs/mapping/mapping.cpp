// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/mapping.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

namespace adit {
namespace {

// How loosely a session hangs on the one before.
constexpr double kElsewhereM = 1000.0;
constexpr double kGapM = 1.0;
constexpr double kGapShare = 0.1;
constexpr double kGapRad = 0.2;
// Half-width of the search around each older map for a body that may be anywhere: maps follow each
// other every few metres [m].
constexpr double kSearchM = 1.0;
constexpr std::size_t kRelocalisations = 3;
// What a place among all of them has to have for it, where nothing else says where the body is:
// wrong places reach about 8, the right one mostly has 20 and more.
constexpr double kRelocalisedLogLikelihood = 15.0;
// Times as many candidates where the likely ones have been wrong.
constexpr int kThorough = 4;
// The newest measurements, whose likelihood is monitored.
constexpr int kMapsMonitored = 4;
// How far from where it is believed to be a map is given the benefit of the doubt.
const Eigen::Vector3d kSurpriseSd(0.2, 0.2, 0.02);

bool begins_session(const LocalMap& map, const std::vector<LocalMap>& before) {
  return !before.empty() && before.back().session != map.session;
}

/// What there is until a map, and of it.
template <class T>
std::span<const T> up_to(int map, const std::vector<T>& all) {
  return std::span(all).first(static_cast<std::size_t>(map) + 1);
}

void sort_by_likelihood(std::vector<Closure>& closures) {
  std::stable_sort(closures.begin(), closures.end(), [](const Closure& a, const Closure& b) {
    return a.alternatives.front().log_likelihood > b.alternatives.front().log_likelihood;
  });
}

}  // namespace

Mapping::Mapping(const MappingParams& params)
    : params_(params),
      mounts_{{"LASER_FRONT", params.lasers.front}, {"LASER_REAR", params.lasers.rear}},
      builder_(params.local_maps),
      association_(params.association) {}

void Mapping::restore(StoredMap stored) {
  if (stored.maps.empty()) return;
  builder_ = LocalMapBuilder(params_.local_maps, stored.maps.back().id + 1,
                             stored.maps.back().session + 1);
  for (LocalMap& map : stored.maps) enter(std::move(map));
  association_.restore(stored.associations);
  odom_continues_ = true;
}

std::optional<MapUpdate> Mapping::add(const std::string& channel, const LaserScan& scan,
                                      const ScanMatch& match) {
  if (!maps_.empty() && match.odom_utime > maps_.back().end_utime) odom_continues_ = false;
  auto map = builder_.add(channel, scan, match);
  if (!map) return std::nullopt;
  return take(std::move(*map));
}

std::optional<MapUpdate> Mapping::finish() {
  auto map = builder_.finish();
  if (!map) return std::nullopt;
  return take(std::move(*map));
}

MapUpdate Mapping::take(LocalMap map) {
  if (begins_session(map, maps_)) link_session(map);
  MapUpdate update;
  update.map = map;
  enter(std::move(map));
  const std::int64_t utime = update.map.end_utime;
  const int newest = update.map.id;
  update.associations = association_.decide(closures(newest, association_.trial(), false), utime);
  const auto revised = association_.revise(*this, utime);
  update.associations.insert(update.associations.end(), revised.begin(), revised.end());
  ++revision_;
  return update;
}

void Mapping::enter(LocalMap map) {
  walls_.push_back(local_walls(map, mounts_, params_.walls));
  extents_.emplace_back(walls_.back());
  association_.add_map(map.T_previous_local, map.information);
  maps_.push_back(std::move(map));
}

/// Ties a session to the end of the one before, loosely: where odom goes on, a few metres of the
/// way are missing at most; otherwise the body may have been carried anywhere.
void Mapping::link_session(LocalMap& map) const {
  const LocalMap& last = maps_.back();
  const Pose2 T_last_end = last.scans.back().T_local_body;
  Eigen::Vector3d sd(kElsewhereM, kElsewhereM, std::numbers::pi);
  map.T_previous_local = T_last_end;
  if (odom_continues_) {
    map.T_previous_local = between(last.T_odom_local, map.T_odom_local);
    const double unseen_m = between(T_last_end, map.T_previous_local).translation().norm();
    sd = {kGapM + kGapShare * unseen_m, kGapM + kGapShare * unseen_m, kGapRad};
  }
  map.information = sd.cwiseInverse().cwiseAbs2().asDiagonal();
}

bool Mapping::session_is_joined() const {
  const int session = maps_.back().session;
  if (maps_.front().session == session) return true;
  const auto session_of = [&](int map) { return maps_[static_cast<std::size_t>(map)].session; };
  const auto in_force = constraints_in_force(association_.problem(), association_.belief());
  return std::any_of(in_force.begin(), in_force.end(), [&](const PoseConstraint& c) {
    return session_of(c.to) == session && session_of(c.from) != session;
  });
}

/// Looks for the newest map all over the older sessions.
std::vector<Closure> Mapping::relocalise() const {
  std::vector<Closure> closures;
  const std::vector<Pose2>& poses = association_.belief().T_map_local;
  const int session = maps_.back().session;
  for (int older = 0; maps_[static_cast<std::size_t>(older)].session != session; ++older) {
    RelativePose anywhere;
    anywhere.T_older_newer = {extents_[static_cast<std::size_t>(older)].centre().x(),
                              extents_[static_cast<std::size_t>(older)].centre().y(), 0.0};
    anywhere.covariance =
        Eigen::Vector3d(kSearchM, kSearchM, std::numbers::pi).cwiseAbs2().asDiagonal();
    Closure closure;
    closure.newer_map = static_cast<int>(maps_.size()) - 1;
    closure.alternatives =
        match_maps(walls_.back(), place_around(older, poses), older, anywhere, params_.matching);
    std::erase_if(closure.alternatives, [](const ClosureAlternative& a) {
      return a.log_likelihood < kRelocalisedLogLikelihood;
    });
    if (!closure.alternatives.empty()) closures.push_back(std::move(closure));
  }
  sort_by_likelihood(closures);
  if (closures.size() > kRelocalisations) closures.resize(kRelocalisations);
  return closures;
}

std::vector<Closure> Mapping::closures(int map, Trial& trial, bool thorough) const {
  if (map < 1) return {};
  const bool newest = map + 1 == static_cast<int>(maps_.size());
  if (newest && !session_is_joined() && !odom_continues_) return relocalise();
  std::vector<Pose2> poses = trial.belief().T_map_local;
  poses.resize(static_cast<std::size_t>(map) + 1);
  ClosureCandidatesParams which = params_.candidates;
  if (thorough) which.most *= kThorough;
  std::vector<Closure> found;
  for (const ClosureCandidate& candidate :
       closure_candidates(poses, trial.covariances_to(map), up_to(map, extents_), which)) {
    Closure closure;
    closure.newer_map = map;
    closure.alternatives =
        match_maps(walls_[static_cast<std::size_t>(map)], place_around(candidate.older, poses),
                   candidate.older, candidate.predicted, params_.matching);
    if (!closure.alternatives.empty()) found.push_back(std::move(closure));
  }
  sort_by_likelihood(found);
  return found;
}

/// What the newest maps and the older ones that they overlap hold against each other where they
/// lie.
double Mapping::surprise(const std::vector<Pose2>& T_map_local) const {
  const int newest = static_cast<int>(maps_.size()) - 1;
  double surprise = 0.0;
  const std::vector<Eigen::Matrix3d> certain(maps_.size(), kSurpriseSd.cwiseAbs2().asDiagonal());
  for (int map = std::max(0, newest - kMapsMonitored + 1); map <= newest; ++map) {
    const auto poses = up_to(map, T_map_local);
    double most = 0.0;
    for (const ClosureCandidate& candidate :
         closure_candidates(poses, certain, up_to(map, extents_), params_.candidates)) {
      most = std::max(most, contradiction(walls_[static_cast<std::size_t>(map)],
                                          place_around(candidate.older, poses),
                                          candidate.predicted.T_older_newer, params_.matching));
    }
    surprise += most;
  }
  return surprise;
}

/// A map and then its neighbours in the chain, in its frame.
std::vector<PlacedWalls> Mapping::place_around(int map, std::span<const Pose2> T_map_local) const {
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  std::vector<PlacedWalls> placed;
  for (const int k : {map, map - 1, map + 1}) {
    if (k < 0 || k >= static_cast<int>(T_map_local.size())) continue;
    if (maps_[at(k)].session != maps_[at(map)].session) continue;
    placed.push_back({&walls_[at(k)], between(T_map_local[at(map)], T_map_local[at(k)])});
  }
  return placed;
}

MapGraph Mapping::graph() const {
  MapGraph graph;
  graph.utime = maps_.empty() ? 0 : maps_.back().end_utime;
  graph.revision = revision_;
  graph.poses = association_.belief().T_map_local;
  for (const PoseConstraint& c : association_.problem().chain) {
    graph.constraints.push_back({c, MapConstraint::Kind::kSequential});
  }
  for (const auto& c : constraints_in_force(association_.problem(), association_.belief())) {
    graph.constraints.push_back({c, MapConstraint::Kind::kClosure});
  }
  return graph;
}

std::optional<MapCorrection> Mapping::correction() const {
  if (maps_.empty()) return std::nullopt;
  const LocalMap& newest = maps_.back();
  MapCorrection correction;
  correction.utime = newest.end_utime;
  correction.revision = revision_;
  correction.session = newest.session;
  correction.local_map = newest.id;
  correction.T_map_odom = association_.belief().T_map_local.back() * newest.T_odom_local.inverse();
  return correction;
}

}  // namespace adit
