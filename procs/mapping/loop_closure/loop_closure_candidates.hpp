// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"
#include "procs/mapping/association/trial.hpp"
#include "procs/mapping/loop_closure/local_walls.hpp"
#include "procs/mapping/loop_closure/map_matching.hpp"

namespace adit {

/// The coarse extent of the walls of a local map, in its frame: sufficient to estimate the overlap
/// of hundreds of maps.
class MapExtent {
 public:
  MapExtent() = default;
  explicit MapExtent(const LocalWalls& walls);

  /// Share of the other map's walls that lie on walls of this map, to a metre or two.
  [[nodiscard]] double overlap(const MapExtent& other, const Pose2& T_this_other) const;

  /// Share of this map's walls that lie on walls of others, each at its `T_this_other`.
  struct Placed {
    const MapExtent* extent = nullptr;
    Pose2 T_this_other;
  };
  [[nodiscard]] double covered_by(const std::vector<Placed>& others) const;

  /// The circle around all walls; radius 0 without walls.
  [[nodiscard]] const Eigen::Vector2d& centre() const { return centre_; }
  [[nodiscard]] double radius_m() const { return radius_m_; }
  /// Distance from the origin within which all walls are.
  [[nodiscard]] double reach_m() const { return centre_.norm() + radius_m_; }

 private:
  [[nodiscard]] bool covers(const Eigen::Vector2d& p) const;

  std::vector<Eigen::Vector2d> samples_;  ///< centre of each square with a wall
  std::vector<std::int64_t> covered_;     ///< these squares and their neighbours, sorted
  Eigen::Vector2d centre_ = Eigen::Vector2d::Zero();
  double radius_m_ = 0.0;
};

struct LoopClosureCandidatesParams {
  int most = 4;         ///< maximum number of candidates for a new local map
  int neighbours = 2;   ///< number of maps before the newest that are its neighbours in the chain
  int apart = 3;        ///< minimum distance of candidates in the chain; nearer ones are redundant
  double sigmas = 3.0;  ///< size of the gate around the predicted pose
  /// Minimum share of the newest map's walls that the older one may have observed.
  double overlap_min = 0.3;

  template <class V>
  void visit(V& v) {
    v("most", most, within(0, 1000));
    v("neighbours", neighbours, within(1, 1000));
    v("apart", apart, within(1, 1000));
    v("sigmas", sigmas, within(0.0, 100.0));
    v("overlap_min", overlap_min, within(0.0, 1.0));
  }
};

/// An older local map that may overlap the newest one.
struct LoopClosureCandidate {
  int older = 0;  ///< index
  RelativePose predicted;
  double overlap = 0.0;  ///< expected share of the newest map's walls that the older one observed
};

/// Selects the older maps against which to match the newest, the last of `poses`: those whose walls
/// it may have observed again, at any pose within the gate of its relative pose (paper, section
/// 2.2). Largest expected overlap first; of maps that are close in the chain only the best, so that
/// each pass by the place is represented.
///   poses:   T_map_local of all local maps
///   near:    the older maps that may be near it, at least, in order; see `Trial::near_maps`
///   extents: of all local maps
std::vector<LoopClosureCandidate> loop_closure_candidates(
    std::span<const Pose2> poses, std::span<const NearMap> near, std::span<const MapExtent> extents,
    const LoopClosureCandidatesParams& params);

/// More of them, for when the likely ones were wrong, and then others farther from the prediction:
/// some displacement was perhaps worse than it states, such as where a laser took rising ground for
/// a wall. Its standard deviation is unknown; for these all are taken to be three times what they
/// state. `near`: in a gate wider by `kThoroughSds`.
constexpr double kThoroughSds = 3.0;
std::vector<LoopClosureCandidate> thorough_candidates(std::span<const Pose2> poses,
                                                      std::span<const NearMap> near,
                                                      std::span<const MapExtent> extents,
                                                      const LoopClosureCandidatesParams& params);

}  // namespace adit
