// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/registration/point_to_line.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace adit {
namespace {

constexpr double kClutterWeight = 0.1;  // which point of the clutter was hit is chance

constexpr double kSharedPoints = 2.5;  // neighbouring normals are fitted to common points
constexpr double kUnitVariance = 2.0 * 0.01 * 0.01;  // [m²] of a good point on a good surfel

/// What goes with a residual: its weight, its variance [m²], what share of a point it stands for,
/// and how uncertain the direction is in which it was taken.
struct Row {
  double weight;
  double variance;
  double share;
  double normal_variance;
};

struct Normals {
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
  Eigen::Matrix3d spurious = Eigen::Matrix3d::Zero();
  double weighted_squares = 0.0;
  double weights = 0.0;
  int corresponding = 0;
  double inliers = 0.0;
  double inlier_squares = 0.0;
  double closeness = 0.0;
};

/// Rows of the Jacobian are taken with respect to a small motion (x, y, θ) in the body frame:
/// p_odom = T · (p + δ_xy + δ_θ × p), so that the information comes out in the body frame.
class Accumulator {
 public:
  Accumulator(const Pose2& T, double scale)
      : c_(std::cos(T.theta)), s_(std::sin(T.theta)), T_(T), scale_(scale) {}

  void add(const SurfacePoint& point, const SurfelMap& reference, double capture) {
    const Eigen::Vector2d p_odom = rotate(point.p) + T_.translation();
    const Eigen::Vector2d n_odom = rotate(point.normal);
    const Surfel* q = reference.nearest(p_odom, n_odom, capture);
    if (q == nullptr) return;
    ++sums_.corresponding;
    const Eigen::Vector2d d = p_odom - q->p;
    if (q->has_normal()) {
      add_row(point.p, rotate_back(q->normal), q->normal.dot(d),
              {point.weight, q->variance + point.variance, 1.0, q->normal_variance});
    } else if (point.has_normal()) {
      add_row(point.p, point.normal, n_odom.dot(d),
              {point.weight, q->variance + point.variance, 1.0, point.normal_variance});
    } else {
      const Eigen::Vector2d d_body = rotate_back(d);
      const Row row{kClutterWeight * point.weight, q->variance + point.variance, 0.5, 0.0};
      add_row(point.p, Eigen::Vector2d::UnitX(), d_body.x(), row);
      add_row(point.p, Eigen::Vector2d::UnitY(), d_body.y(), row);
    }
  }

  [[nodiscard]] const Normals& sums() const { return sums_; }

 private:
  [[nodiscard]] Eigen::Vector2d rotate(const Eigen::Vector2d& v) const {
    return {c_ * v.x() - s_ * v.y(), s_ * v.x() + c_ * v.y()};
  }
  [[nodiscard]] Eigen::Vector2d rotate_back(const Eigen::Vector2d& v) const {
    return {c_ * v.x() + s_ * v.y(), -s_ * v.x() + c_ * v.y()};
  }

  void add_row(const Eigen::Vector2d& p, const Eigen::Vector2d& n, double residual,
               const Row& row) {
    const double unit = residual * std::sqrt(kUnitVariance / std::max(row.variance, 1e-6));
    const double u = unit / scale_;
    const double kernel = 1.0 / ((1.0 + u * u) * (1.0 + u * u));  // Geman-McClure
    const double w = row.weight * kernel * kUnitVariance / std::max(row.variance, 1e-6);
    const Eigen::Vector3d J(n.x(), n.y(), p.x() * n.y() - p.y() * n.x());
    sums_.H.noalias() += w * J * J.transpose();
    sums_.g += w * residual * J;
    // The same row if the normal were turned a quarter: what its error lets through.
    const Eigen::Vector3d K(-n.y(), n.x(), p.x() * n.x() + p.y() * n.y());
    sums_.spurious.noalias() += kSharedPoints * w * row.normal_variance * K * K.transpose();
    sums_.weighted_squares += row.weight * kernel * unit * unit;
    sums_.weights += row.weight * kernel;
    sums_.closeness += row.share / (1.0 + u * u);
    if (std::abs(u) < 2.0) {
      sums_.inliers += row.share;
      sums_.inlier_squares += row.share * unit * unit;
    }
  }

  double c_;
  double s_;
  Pose2 T_;
  double scale_;
  Normals sums_;
};

Normals linearise(const std::vector<SurfacePoint>& points, const SurfelMap& reference,
                  const Pose2& T, double scale, double capture) {
  Accumulator accumulator(T, scale);
  for (const auto& point : points) accumulator.add(point, reference, capture);
  return accumulator.sums();
}

double residual_variance(const Normals& sums, double sd_min) {
  const double variance = sums.weights > 0 ? sums.weighted_squares / sums.weights : 0.0;
  return std::max(variance, sd_min * sd_min);
}

}  // namespace

PointToLineResult match_point_to_line(const std::vector<SurfacePoint>& points_body,
                                      const SurfelMap& reference, const Pose2& start,
                                      const PosePrior& prior, const PointToLineParams& params) {
  PointToLineResult result;
  result.T_odom_body = start;
  if (points_body.empty() || reference.empty()) return result;
  double scale = std::max(params.scale_start_m, params.scale_end_m);
  Normals sums;
  for (result.iterations = 1; result.iterations <= params.iterations_max; ++result.iterations) {
    const double capture = std::min(params.capture_m, std::max(2.5 * scale, 0.25));
    sums = linearise(points_body, reference, result.T_odom_body, scale, capture);
    if (sums.corresponding < 3) return result;
    const double precision = 1.0 / residual_variance(sums, params.residual_sd_min_m);
    const Eigen::Vector3d off = between(prior.T_odom_body, result.T_odom_body).vector();
    // A grain of damping keeps an unconstrained direction where it is.
    const Eigen::Matrix3d damping = Eigen::Matrix3d::Identity() * 1e-6 * precision;
    const Eigen::Matrix3d A = precision * sums.H + prior.information + damping;
    const Eigen::Vector3d step = -A.ldlt().solve(precision * sums.g + prior.information * off);
    result.T_odom_body = result.T_odom_body * Pose2::from_vector(step);
    if (scale <= params.scale_end_m && step.norm() < params.done_m) {
      result.converged = true;
      break;
    }
    // Narrow only once the match has settled at this width: a match that still moves would lose
    // the few points that drive it.
    if (step.norm() < 0.1 * scale) scale = std::max(0.5 * scale, params.scale_end_m);
  }
  result.iterations = std::min(result.iterations, params.iterations_max);
  const double precision = 1.0 / residual_variance(sums, params.residual_sd_min_m);
  result.information = precision * sums.H;
  result.spurious = precision * sums.spurious;
  result.overlap = static_cast<double>(sums.corresponding) / points_body.size();
  result.inlier_share = sums.inliers / points_body.size();
  result.closeness = sums.closeness / points_body.size();
  result.rms_residual_m = sums.inliers > 0 ? std::sqrt(sums.inlier_squares / sums.inliers) : 0.0;
  return result;
}

}  // namespace adit
