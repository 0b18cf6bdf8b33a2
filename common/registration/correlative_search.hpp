// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"
#include "common/registration/surface_points.hpp"
#include "common/registration/surfel_map.hpp"

namespace adit {

struct CorrelativeSearchParams {
  double cell_m = 0.1;  ///< side of a fine cell; also the step of the search
  double angle_step_rad = 0.0175;
  int points_max = 90;        ///< points of the scan that are used, evenly sampled
  double range_max_m = 25.0;  ///< maximum range of these points
  /// Maximum number of blocks expanded; bounds the time of a search without a match.
  int blocks_max = 20000;
  int peak_separation_cells = 4;  ///< peaks within this many cells and angle steps are merged
  double score_min = 0.0;         ///< minimum score of a peak

  template <class V>
  void visit(V& v) {
    v("cell_m", cell_m, within(0.01, 1.0));
    v("angle_step_rad", angle_step_rad, within(0.001, 0.5));
    v("points_max", points_max, within(10, 10000));
    v("range_max_m", range_max_m, within(1.0, 100.0));
    v("blocks_max", blocks_max, within(1, 1000000));
    v("peak_separation_cells", peak_separation_cells, within(1, 100));
    v("score_min", score_min, within(0.0, 1.0));
  }
};

/// The poses to search, around a centre.
struct SearchWindow {
  double radius_m = 1.0;  ///< half-width in x and y
  double angle_rad = 0.6;
  /// Optional Gaussian gate: the inverse covariance of (x, y, θ) of the body in its frame at the
  /// centre, and its size in standard deviations. Zero: the complete window is searched.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  double sigmas = 0.0;
};

struct CorrelationPeak {
  Pose2 T_odom_body;   ///< accurate to a cell or two and an angle step: a start for refinement
  double score = 0.0;  ///< mean closeness of the points to the reference, 0 to 1
};

/// Finds the poses within the window at which the scan matches the reference best: exhaustive over
/// a grid of poses, with coarse levels that bound the fine level from above (Olson, "Real-Time
/// Correlative Scan Matching", ICRA 2009); larger windows use more levels. Returns the best `peaks`
/// distinct poses, best first; empty if the scan or the reference is empty.
std::vector<CorrelationPeak> search_correlation(const std::vector<SurfacePoint>& points_body,
                                                const SurfelMap& reference, const Pose2& centre,
                                                const SearchWindow& window, int peaks,
                                                const CorrelativeSearchParams& params);

}  // namespace adit
