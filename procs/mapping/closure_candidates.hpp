// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"
#include "procs/mapping/map_extent.hpp"
#include "procs/mapping/map_matching.hpp"

namespace adit {

struct ClosureCandidatesParams {
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
struct ClosureCandidate {
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
std::vector<ClosureCandidate> closure_candidates(std::span<const Pose2> poses,
                                                 std::span<const Eigen::Matrix3d> covariances,
                                                 std::span<const MapExtent> extents,
                                                 const ClosureCandidatesParams& params);

}  // namespace adit
