// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/registration/point_to_line.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "common/geometry/symmetric_solve.hpp"

namespace adit {
namespace {

constexpr double kClutterWeight = 0.1;  // clutter has no surface: the association is arbitrary
constexpr double kSharedPoints = 2.5;   // neighbouring normals are fitted to shared points
constexpr double kUnitVariance = 2.0 * 0.01 * 0.01;  // [m²], an accurate point
constexpr double kVarianceMin = 1e-6;                // [m²]
constexpr double kNarrowing = 0.5;                   // ratio of successive kernel widths
constexpr double kConvergedShare = 0.1;              // of the kernel width
constexpr double kCaptureMin = 0.25;                 // [m]
constexpr double kTurned = 0.9998;  // cosine of 1°: beyond, other normals may be compatible

/// A distance along a normal and its weights.
struct Residual {
  double distance;         ///< [m]
  double variance;         ///< of the distance [m²]
  double weight;           ///< relative to other points
  double share;            ///< share of a point that it represents
  double normal_variance;  ///< of the direction of the normal [rad²]
};

/// The part of the normal equations that belongs to the displacement of a grade group in the body
/// frame: its own block, the columns that tie it to the pose, and its gradient.
struct GroupEquations {
  Eigen::Matrix2d H = Eigen::Matrix2d::Zero();
  Eigen::Matrix<double, 3, 2> columns = Eigen::Matrix<double, 3, 2>::Zero();
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  double prior_variances = 0.0;  ///< of the displacement, weighted [m²]
  double weights = 0.0;

  /// Inverse variance of the displacement by the prior; the limit keeps level ground finite.
  [[nodiscard]] double prior_information() const {
    return weights > 0.0 ? 1.0 / std::max(prior_variances / weights, kVarianceMin) : 0.0;
  }
};

using GradeShifts = std::array<Eigen::Vector2d, kGradeGroups>;

/// The normal equations of one iteration, and the statistics of the match. Residuals are normalised
/// to those of an accurate point: divided by their standard deviation, times that of an accurate
/// point.
struct NormalEquations {
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
  /// Part of H that errors of the normals may produce.
  Eigen::Matrix3d spurious = Eigen::Matrix3d::Zero();
  double weights = 0.0;
  double weighted_squares = 0.0;
  int corresponding = 0;
  double inliers = 0.0;
  double inlier_squares = 0.0;
  double closeness = 0.0;
  std::array<GroupEquations, kGradeGroups> groups{};

  /// Estimated variance of the residual of an accurate point.
  [[nodiscard]] double unit_variance(double sd_min) const {
    const double found = weights > 0.0 ? weighted_squares / weights : 0.0;
    return std::max(found, sd_min * sd_min);
  }
};

/// Adds w v vᵀ to the upper triangle.
void add_outer(double w, const Eigen::Vector3d& v, Eigen::Matrix3d& sum) {
  const Eigen::Vector3d wv = w * v;
  sum(0, 0) += wv.x() * v.x();
  sum(0, 1) += wv.x() * v.y();
  sum(1, 1) += wv.y() * v.y();
  sum(0, 2) += wv.x() * v.z();
  sum(1, 2) += wv.y() * v.z();
  sum(2, 2) += wv.z() * v.z();
}

/// The nearest surfel of each point of the scan. Most points move little between iterations: a
/// point is searched again only when it has moved or turned so far that another surfel may be
/// nearest (after Nüchter, Lingemann, Hertzberg, "Cached k-d tree search for ICP algorithms", 3DIM
/// 2007).
class Correspondences {
 public:
  Correspondences(const SurfelMap& reference, std::size_t points)
      : reference_(reference), cached_(points) {}

  /// Null if there is none within `capture`, which must not grow from call to call.
  const Surfel* find(std::size_t point, const Eigen::Vector2d& p_odom,
                     const Eigen::Vector2d& n_odom, double capture) {
    Cached& cached = cached_[point];
    const bool turned = n_odom.dot(cached.normal) < kTurned * n_odom.squaredNorm();
    if (turned || !((p_odom - cached.p).squaredNorm() < cached.clearance_squared)) {
      const auto [surfel, clearance] = reference_.nearest(p_odom, n_odom, capture);
      cached = {p_odom, n_odom, clearance * clearance, surfel};
    }
    if (cached.surfel == nullptr) return nullptr;
    return (cached.surfel->p - p_odom).squaredNorm() < capture * capture ? cached.surfel : nullptr;
  }

 private:
  struct Cached {
    Eigen::Vector2d p = Eigen::Vector2d::Zero();  ///< position of the point at the last search
    Eigen::Vector2d normal = Eigen::Vector2d::Zero();
    double clearance_squared = 0.0;  ///< zero: never searched
    const Surfel* surfel = nullptr;
  };

  const SurfelMap& reference_;
  std::vector<Cached> cached_;
};

/// Sums up the normal equations. Rows of the Jacobian are taken with respect to a small motion (x,
/// y, θ) in the body frame, p_odom = T · (p + δ_xy + δ_θ × p), so that the information is in the
/// body frame. The residual is the distance along the normal of the surfel (Censi 2008, eq. 1);
/// without a normal of the surfel, along that of the point; without either, the distance in x and
/// y.
class Accumulator {
 public:
  Accumulator(const Pose2& T, const GradeShifts& shifts_m, const PointToLineParams& params,
              double scale)
      : c_(std::cos(T.theta)),
        s_(std::sin(T.theta)),
        T_(T),
        per_scale2_(1.0 / (scale * scale)),
        shifts_m_(shifts_m),
        params_(params) {}

  void add(const SurfacePoint& point, std::size_t index, Correspondences& correspondences,
           double capture) {
    const Eigen::Vector2d n_odom = rotate(point.normal);
    group_ = point.grade_group;
    Eigen::Vector2d p_body = unshifted(point);
    Eigen::Vector2d p_odom = rotate(p_body) + T_.translation();
    const Surfel* q = correspondences.find(index, p_odom, n_odom, capture);
    if (q == nullptr) return;
    if (group_ && q->is_steep()) {
      group_.reset();
      p_body = point.p;
      p_odom = rotate(p_body) + T_.translation();
    }
    ++sums_.corresponding;
    const Eigen::Vector2d d = p_odom - q->p;
    const double climb_m = point.z_m - q->z_m;
    const double lean_m = point.lean_sd * climb_m;
    if (group_) add_prior(point, climb_m);
    const double variance = std::max(q->variance + point.variance + lean_m * lean_m, kVarianceMin);
    if (q->has_normal()) {
      add_row(p_body, rotate_back(q->normal),
              {q->normal.dot(d), variance, point.weight, 1.0, q->normal_variance});
    } else if (point.has_normal()) {
      add_row(p_body, point.normal,
              {n_odom.dot(d), variance, point.weight, 1.0, point.normal_variance});
    } else {
      const Eigen::Vector2d d_body = rotate_back(d);
      const double weight = kClutterWeight * point.weight;
      add_row(p_body, Eigen::Vector2d::UnitX(), {d_body.x(), variance, weight, 0.5, 0.0});
      add_row(p_body, Eigen::Vector2d::UnitY(), {d_body.y(), variance, weight, 0.5, 0.0});
    }
  }

  [[nodiscard]] NormalEquations sums() const {
    NormalEquations sums = sums_;
    sums.H = sums_.H.selfadjointView<Eigen::Upper>();
    sums.spurious = kSharedPoints * Eigen::Matrix3d(sums_.spurious.selfadjointView<Eigen::Upper>());
    return sums;
  }

 private:
  [[nodiscard]] Eigen::Vector2d rotate(const Eigen::Vector2d& v) const {
    return {c_ * v.x() - s_ * v.y(), s_ * v.x() + c_ * v.y()};
  }
  [[nodiscard]] Eigen::Vector2d rotate_back(const Eigen::Vector2d& v) const {
    return {c_ * v.x() + s_ * v.y(), -s_ * v.x() + c_ * v.y()};
  }

  /// Where the point would be without the displacement of its group.
  [[nodiscard]] Eigen::Vector2d unshifted(const SurfacePoint& point) const {
    if (!point.grade_group) return point.p;
    return point.p - shifts_m_[static_cast<std::size_t>(*point.grade_group)];
  }

  /// Ground at this range that a beam at laser_m above the plane of the wheels hits has at least
  /// the grade laser_m / range relative to it.
  void add_prior(const SurfacePoint& point, double climb_m) {
    const double range_m = point.p.norm();
    const double inverse_grade = range_m / params_.laser_m;
    const double pitch_m = std::hypot(params_.pitch_sd_rad, point.pitch_sd_rad) * range_m;
    GroupEquations& group = sums_.groups[static_cast<std::size_t>(*group_)];
    group.weights += point.weight;
    group.prior_variances +=
        point.weight * inverse_grade * inverse_grade * (climb_m * climb_m + pitch_m * pitch_m);
  }

  void add_row(const Eigen::Vector2d& p, const Eigen::Vector2d& n, const Residual& r) {
    const double to_unit2 = kUnitVariance / r.variance;
    const double residual2 = r.distance * r.distance * to_unit2;
    const double u2 = residual2 * per_scale2_;
    const double closeness = 1.0 / (1.0 + u2);
    const double kernel = closeness * closeness;  // Geman-McClure
    const double w = r.weight * kernel * to_unit2;
    const Eigen::Vector3d J(n.x(), n.y(), p.x() * n.y() - p.y() * n.x());
    add_outer(w, J, sums_.H);
    sums_.g += w * r.distance * J;
    if (group_) {
      GroupEquations& group = sums_.groups[static_cast<std::size_t>(*group_)];
      group.H += w * n * n.transpose();
      group.columns -= w * J * n.transpose();
      group.gradient -= w * r.distance * n;
    }
    // The same row with the normal turned by 90°: the effect of an error of the normal.
    const Eigen::Vector3d K(-n.y(), n.x(), p.x() * n.x() + p.y() * n.y());
    add_outer(w * r.normal_variance, K, sums_.spurious);
    sums_.weights += r.weight * kernel;
    sums_.weighted_squares += r.weight * kernel * residual2;
    sums_.closeness += r.share * closeness;
    if (u2 < 4.0) {
      sums_.inliers += r.share;
      sums_.inlier_squares += r.share * residual2;
    }
  }

  double c_;
  double s_;
  Pose2 T_;
  double per_scale2_;
  GradeShifts shifts_m_;
  const PointToLineParams& params_;
  std::optional<int> group_;  ///< of the point that is being added
  NormalEquations sums_;
};

/// The state of a match: the pose, and the displacements of the grade groups.
struct MatchState {
  Pose2 T_odom_body;
  GradeShifts shifts_m{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
};

NormalEquations linearise(const std::vector<SurfacePoint>& points, Correspondences& correspondences,
                          const MatchState& state, const PointToLineParams& params, double scale,
                          double capture) {
  Accumulator accumulator(state.T_odom_body, state.shifts_m, params, scale);
  for (std::size_t i = 0; i < points.size(); ++i) {
    accumulator.add(points[i], i, correspondences, capture);
  }
  return accumulator.sums();
}

/// Covariance of a displacement at a fixed pose, by its points and its prior.
Eigen::Matrix2d covariance_of(const GroupEquations& group, double precision) {
  const Eigen::Matrix2d prior = Eigen::Matrix2d::Identity() * group.prior_information();
  return (precision * group.H + prior).inverse();
}

/// The information of the pose after the displacements are eliminated (Schur complement).
Eigen::Matrix3d marginal_information(const NormalEquations& sums, double precision) {
  Eigen::Matrix3d information = precision * sums.H;
  for (const GroupEquations& group : sums.groups) {
    if (group.weights <= 0.0) continue;
    const Eigen::Matrix<double, 3, 2> columns = precision * group.columns;
    information -= columns * covariance_of(group, precision) * columns.transpose();
  }
  return information;
}

Eigen::Vector2d gradient_of(const GroupEquations& group, double precision,
                            const Eigen::Vector2d& shift_m) {
  return precision * group.gradient + group.prior_information() * shift_m;
}

/// Moves the state by the Gauss-Newton step of match and priors together. Returns the step of the
/// pose, in the body frame.
Eigen::Vector3d take_step(const NormalEquations& sums, const PosePrior& prior, double sd_min,
                          MatchState& state) {
  const double precision = 1.0 / sums.unit_variance(sd_min);
  const Eigen::Vector3d off = between(prior.T_odom_body, state.T_odom_body).vector();
  // Small damping keeps the pose along unconstrained directions.
  const Eigen::Matrix3d damping = Eigen::Matrix3d::Identity() * 1e-6 * precision;
  const Eigen::Matrix3d A = marginal_information(sums, precision) + prior.information + damping;
  Eigen::Vector3d g = precision * sums.g + prior.information * off;
  for (std::size_t k = 0; k < kGradeGroups; ++k) {
    const GroupEquations& group = sums.groups[k];
    if (group.weights <= 0.0) continue;
    g -= precision * group.columns * covariance_of(group, precision) *
         gradient_of(group, precision, state.shifts_m[k]);
  }
  Eigen::Vector3d step = -solve_symmetric(A, g);
  for (std::size_t k = 0; k < kGradeGroups; ++k) {
    const GroupEquations& group = sums.groups[k];
    if (group.weights <= 0.0) continue;
    state.shifts_m[k] -=
        covariance_of(group, precision) * (gradient_of(group, precision, state.shifts_m[k]) +
                                           precision * group.columns.transpose() * step);
  }
  state.T_odom_body = state.T_odom_body * Pose2::from_vector(step);
  return step;
}

void fill_statistics(const NormalEquations& sums, std::size_t points, double sd_min,
                     PointToLineResult& result) {
  const double precision = 1.0 / sums.unit_variance(sd_min);
  const auto n = static_cast<double>(points);
  result.information = marginal_information(sums, precision);
  result.spurious = precision * sums.spurious;
  result.overlap = sums.corresponding / n;
  result.inlier_share = sums.inliers / n;
  result.closeness = sums.closeness / n;
  result.rms_residual_m = sums.inliers > 0.0 ? std::sqrt(sums.inlier_squares / sums.inliers) : 0.0;
}

/// Whether an earlier match visited this pose with the same kernel width. Two matches nearer than
/// the convergence threshold at that width are the same.
bool on_trail(const MatchTrail& trail, const Pose2& T, double scale) {
  return std::any_of(trail.begin(), trail.end(), [&](const MatchWaypoint& w) {
    return w.scale_m == scale &&
           between(w.T_odom_body, T).vector().norm() < kConvergedShare * scale;
  });
}

}  // namespace

PointToLineResult match_point_to_line(const std::vector<SurfacePoint>& points_body,
                                      const SurfelMap& reference, const Pose2& start,
                                      const PosePrior& prior, const PointToLineParams& params,
                                      MatchTrail* trail) {
  PointToLineResult result;
  result.T_odom_body = start;
  MatchState state;
  state.T_odom_body = start;
  if (points_body.empty() || reference.empty()) return result;
  const double sd_min = params.residual_sd_min_m;
  double scale = std::max(params.scale_start_m, params.scale_end_m);
  Correspondences correspondences(reference, points_body.size());
  NormalEquations sums;
  MatchTrail visited;
  while (result.iterations < params.iterations_max && !result.converged) {
    if (trail != nullptr) {
      result.duplicate = on_trail(*trail, state.T_odom_body, scale);
      if (result.duplicate) break;
      visited.push_back({state.T_odom_body, scale});
    }
    ++result.iterations;
    const double capture = std::min(params.capture_m, std::max(2.5 * scale, kCaptureMin));
    sums = linearise(points_body, correspondences, state, params, scale, capture);
    if (sums.corresponding < 3) return result;
    const Eigen::Vector3d step = take_step(sums, prior, sd_min, state);
    result.T_odom_body = state.T_odom_body;
    result.converged = scale <= params.scale_end_m && step.norm() < params.done_m;
    // The kernel narrows only after convergence at the current width: narrowing earlier would
    // discard the few points that drive the motion.
    if (step.norm() < kConvergedShare * scale)
      scale = std::max(kNarrowing * scale, params.scale_end_m);
  }
  if (trail != nullptr && (result.converged || result.duplicate)) {
    trail->insert(trail->end(), visited.begin(), visited.end());
  }
  if (result.duplicate) return result;
  fill_statistics(sums, points_body.size(), sd_min, result);
  return result;
}

}  // namespace adit
