// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/config/bounds.hpp"
#include "common/geometry/motion3.hpp"
#include "common/registration/surface_cloud.hpp"
#include "common/types/cloud.hpp"

namespace adit {

struct CloudRegistrationParams {
  double coarse_m = 0.5;      ///< voxels of the first alignment; farther surfaces are not captured
  double fine_m = 0.2;        ///< voxels of the second one
  double range_max_m = 15.0;  ///< of points that are used
  int iterations_max = 20;    ///< of each alignment
  double done_m = 3e-4;       ///< converged at a step below this (metres; radians times lever arm)
  /// Standard deviation of a residual beside the roughness of the surface.
  double residual_sd_m = 0.01;
  /// Neighbouring points lie on one patch, and share the roughness of the wall, seen from two
  /// places: this number of points counts as one measurement.
  double patches_per_measurement = 9.0;
  int inliers_min = 100;
  double inlier_share_min = 0.5;  ///< of the points with a correspondence
  double spurious_ratio = 4.0;    ///< as in DegeneracyParams
  double sd_max_m = 0.1;

  template <class V>
  void visit(V& v) {
    v("coarse_m", coarse_m, within(0.05, 5.0));
    v("fine_m", fine_m, within(0.05, 5.0));
    v("range_max_m", range_max_m, above(0.0));
    v("iterations_max", iterations_max, within(1, 1000));
    v("done_m", done_m, above(0.0));
    v("residual_sd_m", residual_sd_m, above(0.0));
    v("patches_per_measurement", patches_per_measurement, at_least(1.0));
    v("inliers_min", inliers_min, at_least(6));
    v("inlier_share_min", inlier_share_min, within(0.0, 1.0));
    v("spurious_ratio", spurious_ratio, at_least(0.0));
    v("sd_max_m", sd_max_m, above(0.0));
  }
};

/// The surfaces of a 3D scan in the two resolutions of an alignment.
struct RegistrationCloud {
  RegistrationCloud(const Cloud& cloud, const CloudRegistrationParams& params)
      : coarse(cloud, params.coarse_m, params.range_max_m),
        fine(cloud, params.fine_m, params.range_max_m) {}

  SurfaceCloud coarse;
  SurfaceCloud fine;
};

/// A prior of the pose of one 3D scan in another: a Gaussian around T_target_source.
struct CloudPrior {
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();
  /// Inverse covariance of (x, y, z, rotation vector) in source at that pose; zero: no prior.
  Matrix6d information = Matrix6d::Zero();
};

struct CloudRegistration {
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();
  /// Of the registration without the prior, in its constrained directions: inverse covariance of
  /// (x, y, z, rotation vector) in source [m, rad].
  Matrix6d information = Matrix6d::Zero();
  /// Directions that it does not constrain; unit vectors of (x, y, z [m], rotation vector [rad] ·
  /// lever_arm_m) in source. There the pose is that of the prior.
  std::vector<Vector6d> degenerate;
  double lever_arm_m = 1.0;
  double rms_residual_m = 0.0;  ///< of the inliers, along the normals
  double overlap = 0.0;         ///< share of the points of source with a correspondence
  double inlier_share = 0.0;    ///< of these, those within three standard deviations
  int residuals = 0;            ///< points of both scans with a correspondence
  int inliers = 0;
  int iterations = 0;
  bool converged = false;
  /// Whether it converged with enough inliers.
  bool accepted = false;
};

/// Aligns two levelled 3D scans in six degrees of freedom: iterated closest point with the
/// distances of the points of each scan from the surfaces of the other along their normals (Chen
/// and Medioni, "Object modelling by registration of multiple range images", 1992), weighted by the
/// thickness of the surface, a Geman-McClure kernel, from coarse to fine, and the prior as an
/// additional measurement. In both directions, since of a part of the tunnel that one scan sees
/// from nearby the other, 8 m before it, has points too sparse for surfaces. A direction is
/// degenerate if its information does not exceed what the uncertainty of the normals alone
/// produces, or leaves a large standard deviation, as in 2D (`split_degenerate`): the axis of a
/// smooth tunnel. `T_target_source_start`: where it begins.
CloudRegistration register_clouds(const RegistrationCloud& source, const RegistrationCloud& target,
                                  const CloudPrior& prior, const CloudRegistrationParams& params,
                                  const Eigen::Isometry3d& T_target_source_start);
/// Begins at the prior.
CloudRegistration register_clouds(const RegistrationCloud& source, const RegistrationCloud& target,
                                  const CloudPrior& prior, const CloudRegistrationParams& params);

}  // namespace adit
