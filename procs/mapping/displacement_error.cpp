// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/displacement_error.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/LU>

#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

double square(double x) { return x * x; }

bool is_filled_by_wheels(const DegenerateDirection& direction) {
  const bool mostly_turn = std::abs(direction.direction.z()) > 0.7;
  return direction.fill == DegenerateDirection::Fill::kOdometry && !mostly_turn;
}

constexpr double kMatchSdM = 0.01;    // of the motion between two matches
constexpr double kFilledShare = 0.8;  // of a displacement, for a stretch that the wheels measured
constexpr double kExplained = 1.0;  // mean of the squared difference along the direction of a slip

/// The farther of two.
Eigen::Vector3d farther(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a.head<2>().norm() > b.head<2>().norm() ? a : b;
}

double duration_s(const ScanMatch& match) { return seconds(match.utime - match.reference_utime); }

}  // namespace

void DisplacementError::ErrorCovariance::move(const Eigen::Matrix3d& Ad) {
  independent = Ad * independent * Ad.transpose();
  common_root = Ad * common_root;
}

void DisplacementError::ErrorCovariance::add(const ErrorCovariance& other) {
  independent += other.independent;
  common_root += other.common_root;
}

Eigen::Matrix3d DisplacementError::ErrorCovariance::sum() const {
  return independent + common_root * common_root.transpose();
}

void DisplacementError::reset() {
  const bool measured_by_wheels = path_m_ > 0.0 && filled_m_ >= kFilledShare * path_m_;
  earlier_scale_error_ += scale_error_;
  if (!measured_by_wheels) earlier_scale_error_.setZero();
  scale_error_.setZero();
  common_scale_error_.setZero();
  common_scale_sd_ = 0.0;
  path_m_ = 0.0;
  filled_m_ = 0.0;
  accumulated_ = {};
  unobserved_ = {};
  last_step_ = {};
  disagreement_.setZero();
  comparison_ = {};
  slip_.setZero();
  largest_slip_.setZero();
}

void DisplacementError::add_step(const Pose2& T_last_body, const ScanMatch& match,
                                 const std::optional<Pose2>& wheels_step) {
  const Eigen::Matrix3d Ad = adjoint(T_last_body.inverse());
  accumulated_.move(Ad);
  unobserved_.move(Ad);
  scale_error_ = Ad * scale_error_;
  common_scale_error_ = Ad * common_scale_error_;
  earlier_scale_error_ = Ad * earlier_scale_error_;
  path_m_ += T_last_body.translation().norm();
  disagreement_ = Ad * disagreement_;
  slip_ = Ad * slip_;
  largest_slip_ = Ad * largest_slip_;
  comparison_.difference = Ad * comparison_.difference;
  comparison_.wheels.move(Ad);
  add_disagreement(T_last_body, match);
  compare_with_wheels(T_last_body, match, wheels_step);
  if (match.status == ScanMatch::Status::kMatched && match.degenerate.empty()) {
    end_unobserved_stretch();
    return;
  }
  add_filled(T_last_body, match);
  unobserved_.add(unobserved_error(match, wheels_step));
  unobserved_m_ += T_last_body.translation().norm();
  unobserved_lost_ += match.status == ScanMatch::Status::kLost ? 1 : 0;
}

/// Between two matches of one laser lies one of the other: its distance from the motion between the
/// two, in which the acceleration of the body over some hundredths of a second is negligible.
void DisplacementError::add_disagreement(const Pose2& T_last_body, const ScanMatch& match) {
  const Step before = std::exchange(
      last_step_, {last_step_.channel, match.channel, duration_s(match), T_last_body});
  const double both_s = before.duration_s + last_step_.duration_s;
  const bool other_between = before.from_channel == match.channel && !before.channel.empty() &&
                             before.channel != match.channel;
  if (!other_between || !(both_s > 0.0)) return;
  const Pose2 T_body_other = T_last_body.inverse();
  const Pose2 T_body_before = (before.T_last_body * T_last_body).inverse();
  const double share = last_step_.duration_s / both_s;
  const Eigen::Vector3d disagreement = T_body_other.vector() - share * T_body_before.vector();
  if (disagreement.head<2>().norm() > disagreement_.head<2>().norm()) disagreement_ = disagreement;
}

/// Steps that the wheels did not measure count as agreement. The wheels measure along the ground.
void DisplacementError::compare_with_wheels(const Pose2& T_last_body, const ScanMatch& match,
                                            const std::optional<Pose2>& wheels_step) {
  if (comparison_.begin_utime == 0) comparison_.begin_utime = match.reference_utime;
  if (wheels_step) {
    Pose2 level = *wheels_step;
    if (match.attitude) level.x *= std::cos(match.attitude->pitch_rad);
    comparison_.difference += between(level, T_last_body).vector();
    comparison_.wheels.add(wheels_error(level, scale_sd(match)));
  }
  if (seconds(match.utime - comparison_.begin_utime) < params_.compared_s) return;
  slip_ += comparison_.unexplained();
  largest_slip_ = farther(slip_, largest_slip_);
  comparison_ = {};
}

double DisplacementError::scale_sd(const ScanMatch& match) const {
  return std::max(params_.wheels_scale_sd, match.wheels_scale_sd);
}

DisplacementError::ErrorCovariance DisplacementError::wheels_error(const Pose2& step,
                                                                   double scale_sd) const {
  const double length_m = step.translation().norm();
  const double walk = square(params_.wheels_m_per_sqrt_m) * length_m;
  ErrorCovariance error;
  error.independent.diagonal() << walk, walk,
      square(params_.wheels_rad_per_sqrt_m) * length_m +
          square(params_.wheels_rad_per_rad * step.theta);
  error.common_root.col(0) = scale_sd * Eigen::Vector3d(step.x, step.y, 0.0);
  return error;
}

/// Shrinks the difference by the share that noise explains (James and Stein, "Estimation with
/// quadratic loss", 1961): continuous, so that several small slips count as well as a large one.
/// The place decides, since wheels that skid in turns measure these badly.
Eigen::Vector3d DisplacementError::WheelComparison::unexplained() const {
  const Eigen::Matrix2d claimed =
      wheels.sum().topLeftCorner<2, 2>() + square(kMatchSdM) * Eigen::Matrix2d::Identity();
  const Eigen::Vector2d place = difference.head<2>();
  const double squared = place.dot(claimed.inverse() * place);
  return std::max(0.0, 1.0 - kExplained / std::max(squared, kExplained)) * difference;
}

void DisplacementError::end_unobserved_stretch() {
  if (unobserved_m_ > params_.unobserved_max_m || unobserved_lost_ > params_.lost_max_bridged)
    accumulated_.add(unobserved_);
  unobserved_ = {};
  unobserved_m_ = 0.0;
  unobserved_lost_ = 0;
}

/// Of a step of any length without a scan that matched: the walk of the wheels, whose heading error
/// displaces the end of a long step. The covariance of the match has an error per metre, which over
/// a long step makes even the opposite heading likely. Empty if the wheels did not measure the
/// step.
std::optional<DisplacementError::ErrorCovariance> DisplacementError::carried_error(
    const ScanMatch& match, const std::optional<Pose2>& wheels_step) const {
  if (!wheels_step) return std::nullopt;
  ErrorCovariance error = wheels_error(*wheels_step, scale_sd(match));
  double& heading = error.independent(2, 2);
  heading = std::min(heading, match.covariance(2, 2));
  // Of a heading that walks along a straight step: the variance across it, L²/3.
  const double across = heading * wheels_step->translation().squaredNorm() / 3.0;
  error.independent.topLeftCorner<2, 2>().diagonal().array() += across;
  if (error.sum().trace() >= match.covariance.trace()) return std::nullopt;
  return error;
}

DisplacementError::ErrorCovariance DisplacementError::unobserved_error(
    const ScanMatch& match, const std::optional<Pose2>& wheels_step) const {
  ErrorCovariance part;
  if (match.status == ScanMatch::Status::kMatched) {
    for (const auto& direction : match.degenerate) {
      if (!is_filled_by_wheels(direction)) part.add(unconstrained_error(direction, match));
    }
    return part;
  }
  if (const auto carried = carried_error(match, wheels_step)) return *carried;
  // The pose is the prediction: by an assumed speed, or by odometry if the covariance is smaller.
  const Eigen::Vector3d sd =
      duration_s(match) *
      Eigen::Vector3d(params_.speed_sd_m_s, params_.speed_sd_m_s, params_.turn_sd_rad_s);
  const bool measured =
      match.status == ScanMatch::Status::kLost && match.covariance.trace() < sd.squaredNorm();
  if (measured) {
    part.independent = match.covariance;
  } else {
    part.common_root = sd.asDiagonal();
  }
  return part;
}

void DisplacementError::add_filled(const Pose2& T_last_body, const ScanMatch& match) {
  if (match.status != ScanMatch::Status::kMatched) return;
  const Eigen::Vector2d step = T_last_body.translation();
  for (const auto& direction : match.degenerate) {
    if (!is_filled_by_wheels(direction)) continue;
    const Eigen::Vector3d& v = direction.direction;
    const Eigen::Vector3d u = v.cwiseQuotient(Eigen::Vector3d(1.0, 1.0, match.lever_arm_m));
    const double along_m = v.head<2>().dot(step);
    const Eigen::Vector3d scale_error = scale_sd(match) * along_m * u;
    ErrorCovariance error;
    error.independent = square(params_.wheels_m_per_sqrt_m) * step.norm() * u * u.transpose();
    error.common_root = scale_error * Eigen::RowVector3d::UnitX();
    accumulated_.add(error);
    scale_error_ += scale_error;
    const double common_sd =
        std::sqrt(std::max(0.0, square(scale_sd(match)) - square(params_.wheels_scale_sd)));
    common_scale_error_ += common_sd * along_m * u;
    common_scale_sd_ = std::max(common_scale_sd_, common_sd);
    filled_m_ += std::abs(along_m);
  }
}

/// How many times the covariance contains that of the error of scale: once, and as it is that of
/// the stretch before, too, by the mixed term of the square of the sum of both. Only where it adds
/// up, not in reverse.
double DisplacementError::scale_covariances() const {
  const double squared = scale_error_.squaredNorm();
  if (!(squared > 0.0)) return 0.0;
  return 1.0 + std::max(0.0, 2.0 * earlier_scale_error_.dot(scale_error_) / squared);
}

WheelScaleError DisplacementError::wheel_scale_error() const {
  return {common_scale_error_, common_scale_sd_, scale_covariances()};
}

DisplacementError::ErrorCovariance DisplacementError::unconstrained_error(
    const DegenerateDirection& direction, const ScanMatch& match) const {
  ErrorCovariance part;
  const double lever = match.lever_arm_m;
  const Eigen::Vector3d& v = direction.direction;
  const Eigen::Vector3d u = v.cwiseQuotient(Eigen::Vector3d(1.0, 1.0, lever));
  if (direction.fill == DegenerateDirection::Fill::kNone) {
    const Eigen::Vector3d sd(params_.speed_sd_m_s, params_.speed_sd_m_s,
                             params_.turn_sd_rad_s * lever);
    part.common_root = duration_s(match) * u * v.cwiseProduct(sd).transpose();
  } else {
    const Eigen::Vector3d w = v.cwiseProduct(Eigen::Vector3d(1.0, 1.0, lever));
    part.independent = w.dot(match.covariance * w) * u * u.transpose();
  }
  return part;
}

void DisplacementError::add_travel(double distance_m, double turn_rad) {
  // A wall is the mean of its scans: fewer scans constrain it less.
  const double effective_distance_m = distance_m * std::max(1.0, distance_m / params_.dense_m);
  const double xy = square(params_.drift_m_per_sqrt_m) * effective_distance_m;
  const double theta = square(params_.drift_rad_per_sqrt_m) * effective_distance_m +
                       square(params_.drift_rad_per_sqrt_rad) * std::abs(turn_rad);
  accumulated_.independent.diagonal() += Eigen::Vector3d(xy, xy, theta);
}

Eigen::Matrix3d DisplacementError::covariance() const {
  ErrorCovariance all = accumulated_;
  all.add(unobserved_);
  const Eigen::Vector3d slip = farther(slip_ + comparison_.unexplained(), largest_slip_);
  const double earlier = std::max(0.0, scale_covariances() - 1.0);
  Eigen::Matrix3d covariance = all.sum() + earlier * scale_error_ * scale_error_.transpose() +
                               0.25 * disagreement_ * disagreement_.transpose() +
                               0.25 * slip * slip.transpose();
  covariance.diagonal() +=
      Eigen::Vector3d(square(params_.floor_m), square(params_.floor_m), square(params_.floor_rad));
  return covariance;
}

}  // namespace adit
