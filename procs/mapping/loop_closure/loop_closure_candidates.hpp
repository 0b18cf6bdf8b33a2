// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"
#include "procs/mapping/loop_closure/local_walls.hpp"
#include "procs/mapping/loop_closure/map_matching.hpp"

namespace adit {

/// Where the walls of a local map are, roughly: enough to say how much of one map another may see
/// again, for hundreds of maps at a time. In the frame of the local map.
class MapExtent {
 public:
  MapExtent() = default;
  explicit MapExtent(const LocalWalls& walls);

  /// Share of the other's walls that lie where this one has walls, to a metre or two.
  [[nodiscard]] double overlap(const MapExtent& other, const Pose2& T_this_other) const;

  /// Share of its walls that lie where others have walls, each of them at its `T_this_other`.
  struct Placed {
    const MapExtent* extent = nullptr;
    Pose2 T_this_other;
  };
  [[nodiscard]] double covered_by(const std::vector<Placed>& others) const;

  /// The circle around all walls; radius 0 where there are none.
  [[nodiscard]] const Eigen::Vector2d& centre() const { return centre_; }
  [[nodiscard]] double radius_m() const { return radius_m_; }

 private:
  [[nodiscard]] bool covers(const Eigen::Vector2d& p) const;

  std::vector<Eigen::Vector2d> samples_;  ///< middle of each square with a wall
  std::vector<std::int64_t> covered_;     ///< these squares and those around them, in order
  Eigen::Vector2d centre_ = Eigen::Vector2d::Zero();
  double radius_m_ = 0.0;
};

struct LoopClosureCandidatesParams {
  int most = 4;              ///< candidates for a new local map
  int neighbours = 2;        ///< maps before the newest that are its neighbours in the chain
  int apart = 3;             ///< candidates closer in the chain than this say the same
  double sigmas = 3.0;       ///< how far from where it is expected a map may lie
  double overlap_min = 0.3;  ///< share of the newest map's walls that the older one may have seen

  template <class V>
  void visit(V& v) {
    v("most", most, within(0, 1000));
    v("neighbours", neighbours, within(1, 1000));
    v("apart", apart, within(1, 1000));
    v("sigmas", sigmas, within(0.0, 100.0));
    v("overlap_min", overlap_min, within(0.0, 1.0));
  }
};

/// An older local map that the newest one may have come back to.
struct LoopClosureCandidate {
  int older = 0;  ///< index
  RelativePose predicted;
  double overlap = 0.0;  ///< expected share of the newest map's walls that the older one saw
};

/// Which older maps the newest, the last of `poses`, is to be matched against: those whose walls it
/// may have seen again, wherever it is within the gate of its relative pose (paper, section 2.2).
/// The largest expected overlap first, and of those that lie close together in the chain the best,
/// so that each pass by the place is asked.
///   poses:       T_map_local of all local maps
///   covariances: for each older map, of T_older_newest as (x, y, θ) in the newest frame
///   extents:     of all local maps
std::vector<LoopClosureCandidate> loop_closure_candidates(
    std::span<const Pose2> poses, std::span<const Eigen::Matrix3d> covariances,
    std::span<const MapExtent> extents, const LoopClosureCandidatesParams& params);

}  // namespace adit
