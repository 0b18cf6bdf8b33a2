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
  double cell_m = 0.1;  ///< side of a fine cell, and the step of the search
  double angle_step_rad = 0.0175;
  int points_max = 90;            ///< of the scan, evenly chosen
  double range_max_m = 25.0;      ///< among those within this range
  int blocks_max = 20000;         ///< blocks opened; bounds the time in a hopeless case
  int peak_separation_cells = 4;  ///< peaks no farther apart, and no more angle steps, are one
  double score_min = 0.0;         ///< peaks below are not looked for

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

/// The poses to be searched, around a centre.
struct SearchWindow {
  double radius_m = 1.0;  ///< half-widths
  double angle_rad = 0.6;
  /// Where it is known how x, y and θ of the body in its frame at the centre go together: the
  /// inverse of their covariance, and how many standard deviations are searched. Zero: all in the
  /// window.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  double sigmas = 0.0;
};

struct CorrelationPeak {
  Pose2 T_odom_body;   ///< to a cell or two and an angle step: a start for refinement, not a result
  double score = 0.0;  ///< in [0, 1]: mean closeness of the points to the reference
};

/// The poses within the window at which the scan lies best on the reference: exhaustive over a grid
/// of poses, made cheap by coarse levels that bound the fine one from above (Olson, "Real-Time
/// Correlative Scan Matching", ICRA 2009); the larger the window, the more levels. The best `peaks`
/// that are apart, best first; empty where scan or reference is empty.
std::vector<CorrelationPeak> search_correlation(const std::vector<SurfacePoint>& points_body,
                                                const SurfelMap& reference, const Pose2& centre,
                                                const SearchWindow& window, int peaks,
                                                const CorrelativeSearchParams& params);

}  // namespace adit
