// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/mapping.hpp"

#include <algorithm>
#include <utility>

#include <Eigen/Geometry>

#include "common/pose_graph/gaussian_field.hpp"

namespace adit {
namespace {

/// Rotates the covariance of a relative pose from the frame of the older map into the newer one.
Eigen::Matrix3d in_newer_frame(const Eigen::Matrix3d& covariance, const Pose2& T_older_newer) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(-T_older_newer.theta).toRotationMatrix();
  return R * covariance * R.transpose();
}

}  // namespace

Mapping::Mapping(const MappingParams& params)
    : params_(params),
      mounts_{{"LASER_FRONT", params.laser_front}, {"LASER_REAR", params.laser_rear}},
      builder_(params.local_maps),
      association_(params.association) {}

std::optional<MapUpdate> Mapping::add(const std::string& channel, const LaserScan& scan,
                                      const ScanMatch& match) {
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
  walls_.push_back(local_walls(map, mounts_, params_.walls));
  extents_.emplace_back(walls_.back());
  association_.add_map(map.T_previous_local, map.information);
  maps_.push_back(map);
  MapUpdate update;
  update.associations = association_.decide(find_closures(), map.end_utime);
  update.map = std::move(map);
  ++revision_;
  return update;
}

std::vector<Closure> Mapping::find_closures() const {
  const int newest = static_cast<int>(maps_.size()) - 1;
  if (newest < 1) return {};
  const Belief& belief = association_.belief();
  const GaussianField field(graph_of(association_.problem(), belief));
  auto covariances = field.relative_covariances_to(newest);
  for (std::size_t i = 0; i < covariances.size(); ++i) {
    covariances[i] = in_newer_frame(
        covariances[i], between(belief.T_map_local[i], belief.T_map_local.back()));
  }
  std::vector<Closure> closures;
  for (const ClosureCandidate& candidate :
       closure_candidates(belief.T_map_local, covariances, extents_, params_.candidates)) {
    Closure closure;
    closure.newer_map = newest;
    closure.alternatives = match_maps(walls_.back(), place_around(candidate.older), candidate.older,
                                      candidate.predicted, params_.matching);
    if (!closure.alternatives.empty()) closures.push_back(std::move(closure));
  }
  std::stable_sort(closures.begin(), closures.end(), [](const Closure& a, const Closure& b) {
    return a.alternatives.front().log_likelihood > b.alternatives.front().log_likelihood;
  });
  return closures;
}

/// A map and then its neighbours in the chain, in its frame.
std::vector<PlacedWalls> Mapping::place_around(int map) const {
  const auto& poses = association_.belief().T_map_local;
  std::vector<PlacedWalls> placed;
  for (const int k : {map, map - 1, map + 1}) {
    if (k < 0) continue;
    const auto i = static_cast<std::size_t>(k);
    placed.push_back({&walls_[i], between(poses[static_cast<std::size_t>(map)], poses[i])});
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
  const auto& closures = association_.problem().closures;
  for (std::size_t k = 0; k < closures.size(); ++k) {
    const int chosen = association_.belief().chosen[k];
    if (chosen == Association::kNone) continue;
    graph.constraints.push_back(
        {constraint_of(closures[k], chosen), MapConstraint::Kind::kClosure});
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
  correction.T_map_odom =
      association_.belief().T_map_local.back() * newest.T_odom_local.inverse();
  return correction;
}

}  // namespace adit
