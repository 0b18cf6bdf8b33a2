// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"

namespace adit {

/// A possible pose of a local map of a run on a local map of another one.
struct RunLink {
  int older = 0;  ///< local map of the map
  int newer = 0;  ///< local map of the run
  Pose2 T_older_newer;
  double log_likelihood = 0.0;  ///< as in LoopClosureAlternative
  /// The middle of the walls that fix the pose in the direction in which it is least certain, in
  /// the frame of `newer` [m]. Two links by the same walls, such as by the end of a straight
  /// tunnel, are one observation.
  Eigen::Vector2d p_newer_evidence{0.0, 0.0};
};

struct RunAlignmentParams {
  double place_m = 8.0;          ///< evidence nearer than this is of one place
  int places_min = 3;            ///< places that must agree: what looks alike once may be elsewhere
  double position_m = 0.5;       ///< tolerated disagreement of two links,
  double position_per_m = 0.03;  ///< its growth with their distance along the run,
  double angle_rad = 0.06;       ///< and of the angle
  double angle_per_m = 0.001;
  /// Share of the places of the best alignment above which another one is tried, too.
  double rival_share = 0.5;

  template <class V>
  void visit(V& v) {
    v("place_m", place_m, above(0.0));
    v("places_min", places_min, within(1, 1000));
    v("position_m", position_m, above(0.0));
    v("position_per_m", position_per_m, within(0.0, 1.0));
    v("angle_rad", angle_rad, above(0.0));
    v("angle_per_m", angle_per_m, within(0.0, 1.0));
    v("rival_share", rival_share, within(0.0, 1.0));
  }
};

/// Where a run lies in a map, by the links that agree with each other.
struct RunAlignment {
  Pose2 T_map_run;
  std::vector<std::size_t> agreeing;  ///< links, by index
  int places = 0;                     ///< of their evidence
};

/// The number of places of which any two are at least `place_m` apart, chosen in the order of the
/// points.
int distinct_places(const std::vector<Eigen::Vector2d>& points, double place_m);

/// Finds where the run may lie: the alignment with which most places agree (the largest set of
/// links that are consistent with one of them, along both maps as they are bent now), and the best
/// ones that put the run elsewhere than all before, as long as they have more than `rival_share` of
/// its places. Empty without links.
///   map_poses: T_map_local of the map, run_poses: T_run_local of the run
std::vector<RunAlignment> align_run(const std::vector<RunLink>& links,
                                    const std::vector<Pose2>& map_poses,
                                    const std::vector<Pose2>& run_poses,
                                    const RunAlignmentParams& params);

}  // namespace adit
