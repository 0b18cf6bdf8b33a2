// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/registration/cloud_registration.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/geometry/symmetric_eigen.hpp"
#include "common/geometry/symmetric_solve.hpp"

namespace adit {
namespace {

constexpr double kSigmas = 3.0;

Eigen::Isometry3d moved(const Eigen::Isometry3d& T, const Vector6d& step) {
  Eigen::Isometry3d result = T * isometry_of(step);
  result.linear() = Eigen::Quaterniond(result.linear()).normalized().toRotationMatrix();
  return result;
}

/// Root mean square distance from the laser: the displacement of the points per radian of turn.
double lever_arm_m(const SurfaceCloud& cloud) {
  double squares = 0.0;
  for (const SurfacePatch& patch : cloud.patches()) squares += patch.p.squaredNorm();
  const auto n = static_cast<double>(std::max<std::size_t>(1, cloud.patches().size()));
  return std::max(0.5, std::sqrt(squares / n));
}

/// The normal equations at a pose, and how well the scans agree there.
struct Linearised {
  Matrix6d information = Matrix6d::Zero();
  Matrix6d spurious = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  int corresponding = 0;  ///< points of the source
  int residuals = 0;      ///< of both scans
  int inliers = 0;
  double squares_m2 = 0.0;  ///< of the inliers
};

/// How points of one scan lie on the surfaces of the other.
class CloudCorrespondences {
 public:
  /// `scale_m`: width of the kernel.
  CloudCorrespondences(const Eigen::Isometry3d& T_target_source, double scale_m,
                       const CloudRegistrationParams& params)
      : T_(T_target_source), T_inverse_(T_.inverse()), scale_m_(scale_m), params_(params) {}

  void add_source_on_target(const SurfaceCloud& source, const SurfaceCloud& target) {
    const Eigen::Matrix3d R_source_target = T_.linear().transpose();
    for (const ThinnedPoint& point : source.points()) {
      const Eigen::Vector3d p = T_ * point.p;
      const SurfacePatch* const found = target.nearest(p, T_ * point.origin);
      if (found == nullptr) continue;
      ++at_.corresponding;
      add(found->normal.dot(p - found->p), point.p, R_source_target * found->normal, *found);
    }
  }

  /// A point of the target moves in the frame of the source against the motion of the source.
  void add_target_on_source(const SurfaceCloud& source, const SurfaceCloud& target) {
    for (const ThinnedPoint& point : target.points()) {
      const Eigen::Vector3d p = T_inverse_ * point.p;
      const SurfacePatch* const found = source.nearest(p, T_inverse_ * point.origin);
      if (found == nullptr) continue;
      add(found->normal.dot(p - found->p), p, -found->normal, *found);
    }
  }

  [[nodiscard]] const Linearised& result() const { return at_; }

 private:
  /// `p`, `normal`: in source, at the pose; the residual grows where the source moves along them.
  void add(double residual_m, const Eigen::Vector3d& p, const Eigen::Vector3d& normal,
           const SurfacePatch& surface) {
    const double variance =
        params_.residual_sd_m * params_.residual_sd_m + surface.sd_m * surface.sd_m;
    ++at_.residuals;
    if (residual_m * residual_m < kSigmas * kSigmas * variance) {
      ++at_.inliers;
      at_.squares_m2 += residual_m * residual_m;
    }
    const double width_m2 = scale_m_ * scale_m_ + variance;
    const double kernel = width_m2 / (width_m2 + residual_m * residual_m);
    const double weight = kernel * kernel / (variance * params_.patches_per_measurement);
    Vector6d jacobian;
    jacobian << normal, p.cross(normal);
    at_.information += weight * jacobian * jacobian.transpose();
    at_.gradient += weight * residual_m * jacobian;
    Eigen::Matrix<double, 6, 3> by_normal;
    by_normal << Eigen::Matrix3d::Identity(), skew(p);
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - normal * normal.transpose();
    at_.spurious += weight * surface.normal_variance * by_normal * across * by_normal.transpose();
  }

  const Eigen::Isometry3d& T_;
  Eigen::Isometry3d T_inverse_;
  double scale_m_;
  const CloudRegistrationParams& params_;
  Linearised at_;
};

Linearised linearise(const SurfaceCloud& source, const SurfaceCloud& target,
                     const Eigen::Isometry3d& T, double scale_m,
                     const CloudRegistrationParams& params) {
  CloudCorrespondences correspondences(T, scale_m, params);
  correspondences.add_source_on_target(source, target);
  correspondences.add_target_on_source(source, target);
  return correspondences.result();
}

/// The part of the normal equations in constrained directions.
struct Constrained {
  Matrix6d information = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  std::vector<Vector6d> degenerate;
};

/// What does not constrain the pose must not move it either (Zhang, Kaess, Singh, "On degeneracy of
/// optimization-based state estimation problems", ICRA 2016, section V).
Constrained constrained(const Linearised& at, double lever_arm,
                        const CloudRegistrationParams& params) {
  Vector6d to_radians = Vector6d::Ones();
  to_radians.tail<3>().setConstant(1.0 / lever_arm);
  const Vector6d to_metres = to_radians.cwiseInverse();
  const SymmetricEigen<6> principal =
      symmetric_eigen(Matrix6d(to_radians.asDiagonal() * at.information * to_radians.asDiagonal()));
  const Matrix6d spurious = to_radians.asDiagonal() * at.spurious * to_radians.asDiagonal();
  const double least = 1.0 / (params.sd_max_m * params.sd_max_m);
  Constrained result;
  for (int i = 0; i < 6; ++i) {
    const Vector6d v = principal.vectors.col(i);
    if (principal.values[i] <= std::max(least, params.spurious_ratio * v.dot(spurious * v))) {
      result.degenerate.push_back(v);
      continue;
    }
    const Vector6d w = to_metres.asDiagonal() * v;
    const Vector6d u = to_radians.asDiagonal() * v;
    result.information += principal.values[i] * w * w.transpose();
    result.gradient += w * u.dot(at.gradient);
  }
  return result;
}

}  // namespace

CloudRegistration register_clouds(const RegistrationCloud& source, const RegistrationCloud& target,
                                  const CloudPrior& prior, const CloudRegistrationParams& params) {
  return register_clouds(source, target, prior, params, prior.T_target_source);
}

CloudRegistration register_clouds(const RegistrationCloud& source, const RegistrationCloud& target,
                                  const CloudPrior& prior, const CloudRegistrationParams& params,
                                  const Eigen::Isometry3d& T_target_source_start) {
  CloudRegistration result;
  result.T_target_source = T_target_source_start;
  result.lever_arm_m = lever_arm_m(source.fine);
  // A weak prior in all directions makes the equations solvable: the pose does not move where
  // nothing constrains it.
  Matrix6d prior_information = prior.information;
  prior_information.diagonal().array() += 1e-3;
  struct Level {
    const SurfaceCloud& source;
    const SurfaceCloud& target;
  };
  const Level levels[] = {{source.coarse, target.coarse}, {source.fine, target.fine}};
  Linearised at;
  Constrained found;
  for (const Level& level : levels) {
    double scale_m = level.target.voxel_m();
    result.converged = false;
    for (int i = 0; i < params.iterations_max && !result.converged; ++i) {
      at = linearise(level.source, level.target, result.T_target_source, scale_m, params);
      const Vector6d deviation =
          motion_of(prior.T_target_source.inverse() * result.T_target_source);
      found = constrained(at, result.lever_arm_m, params);
      const Vector6d step =
          -solve_symmetric(Matrix6d(found.information + prior_information),
                           Vector6d(found.gradient + prior_information * deviation));
      result.T_target_source = moved(result.T_target_source, step);
      ++result.iterations;
      const double step_m =
          std::max(step.head<3>().norm(), step.tail<3>().norm() * result.lever_arm_m);
      const double narrow_m = 0.1 * level.target.voxel_m();
      result.converged = step_m < params.done_m && scale_m <= narrow_m;
      scale_m = std::max(narrow_m, 0.7 * scale_m);
    }
  }
  result.degenerate = std::move(found.degenerate);
  result.information = found.information;
  result.residuals = at.residuals;
  result.inliers = at.inliers;
  const auto points = static_cast<double>(std::max<std::size_t>(1, source.fine.points().size()));
  result.overlap = at.corresponding / points;
  result.inlier_share = at.inliers / std::max(1.0, static_cast<double>(at.residuals));
  result.rms_residual_m = std::sqrt(at.squares_m2 / std::max(1, at.inliers));
  result.accepted = result.converged && result.inliers >= params.inliers_min &&
                    result.inlier_share >= params.inlier_share_min;
  return result;
}

}  // namespace adit
