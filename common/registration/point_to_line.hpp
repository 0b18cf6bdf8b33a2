// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"
#include "common/registration/surface_points.hpp"
#include "common/registration/surfel_map.hpp"

namespace adit {

struct PointToLineParams {
  int iterations_max = 30;
  double capture_m = 0.5;            ///< maximum distance of a correspondence
  double scale_start_m = 0.2;        ///< initial width of the robust kernel
  double scale_end_m = 0.04;         ///< final width; a point beyond twice this is an outlier
  double residual_sd_min_m = 0.005;  ///< lower bound of the residual's standard deviation per point
  double done_m = 1e-4;  ///< converged at a step below this (metres; radians times one metre)
  double laser_m = 0.6;  ///< height of the lasers above the ground that they may observe
  /// Standard deviation of the change of the body's pitch over the reference.
  double pitch_sd_rad = 0.001;

  template <class V>
  void visit(V& v) {
    v("iterations_max", iterations_max, within(1, 1000));
    v("capture_m", capture_m, within(0.01, SurfelMap::kReach));
    v("scale_start_m", scale_start_m, within(0.005, 5.0));
    v("scale_end_m", scale_end_m, within(0.001, 5.0));
    v("residual_sd_min_m", residual_sd_min_m, within(1e-4, 1.0));
    v("done_m", done_m, within(1e-9, 0.1));
    v("laser_m", laser_m, above(0.0));
    v("pitch_sd_rad", pitch_sd_rad, at_least(0.0));
  }
};

/// Prior of the pose: a Gaussian around T_odom_body.
struct PosePrior {
  Pose2 T_odom_body;
  /// Inverse covariance of (x, y, θ) in the body frame at T_odom_body; zero: no prior.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
};

constexpr int kGradeGroups = 2;  ///< grade groups are 0 and 1

struct PointToLineResult {
  Pose2 T_odom_body;
  /// Information of the match without the prior: inverse covariance of (x, y, θ) in the body frame.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  /// The part of `information` that the uncertainty of the surface normals alone would produce: a
  /// direction with no more than a few times this is not constrained.
  Eigen::Matrix3d spurious = Eigen::Matrix3d::Zero();
  double overlap = 0.0;       ///< share of the points with a correspondence
  double inlier_share = 0.0;  ///< share of the points that agree with the reference
  double closeness = 0.0;     ///< mean over all points, 1 on the reference, 0 far from it
  /// Of the inliers, normalised to that of an accurate point near the laser.
  double rms_residual_m = 0.0;
  int iterations = 0;
  bool converged = false;
  bool duplicate = false;  ///< stopped on the trail of an earlier match, which it would repeat
};

/// A pose visited by a match of the scan that converged, and the kernel width there.
struct MatchWaypoint {
  Pose2 T_odom_body;
  double scale_m = 0.0;
};
using MatchTrail = std::vector<MatchWaypoint>;

/// Aligns the points of a scan with the reference: iterated closest point with distances along the
/// surface normal (Censi, "An ICP variant using a point-to-line metric", ICRA 2008), a
/// Geman-McClure kernel that narrows from coarse to fine, and the prior as an additional
/// measurement. Points of a grade group may lie on rising ground or a falling roof, where the place
/// that a level beam hits moves as the body climbs, by at most range / laser_m for each metre of
/// height: each group has a common unknown displacement, with this prior, except where the
/// reference is steep. Without these groups the result does not depend on heights but by `lean_sd`.
/// `trail` holds the iterates of earlier matches of the same scan that differ in their start only:
/// a match stops when it joins the trail, and adds its own iterates if it converges or joins.
PointToLineResult match_point_to_line(const std::vector<SurfacePoint>& points_body,
                                      const SurfelMap& reference, const Pose2& start,
                                      const PosePrior& prior, const PointToLineParams& params,
                                      MatchTrail* trail = nullptr);

}  // namespace adit
