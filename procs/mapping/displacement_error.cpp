// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/displacement_error.hpp"

#include <cmath>

namespace adit {
namespace {

double square(double x) { return x * x; }

double duration_s(const ScanMatch& match) {
  return 1e-6 * static_cast<double>(match.utime - match.reference_utime);
}

}  // namespace

void DisplacementError::restart() {
  independent_.setZero();
  common_root_.setZero();
}

void DisplacementError::add_step(const Pose2& T_last_body, const ScanMatch& match) {
  const Eigen::Matrix3d Ad = adjoint(T_last_body.inverse());
  independent_ = Ad * independent_ * Ad.transpose();
  common_root_ = Ad * common_root_;
  switch (match.status) {
    case ScanMatch::Status::kMatched:
      for (const auto& open : match.degenerate) add_open(open, match, duration_s(match));
      break;
    case ScanMatch::Status::kLost:
      independent_ += match.covariance;
      break;
    case ScanMatch::Status::kFirstScan:  // of one more laser: the pose is the prediction
      common_root_ +=
          duration_s(match) *
          Eigen::Vector3d(params_.speed_sd_m_s, params_.speed_sd_m_s, params_.turn_sd_rad_s)
              .asDiagonal()
              .toDenseMatrix();
      break;
    case ScanMatch::Status::kRefused:
      break;
  }
}

void DisplacementError::add_open(const DegenerateDirection& open, const ScanMatch& match,
                                 double dt_s) {
  const double lever = match.lever_arm_m;
  const Eigen::Vector3d& v = open.direction;
  const Eigen::Vector3d u = v.cwiseQuotient(Eigen::Vector3d(1.0, 1.0, lever));
  if (open.fill == DegenerateDirection::Fill::kNone) {
    const Eigen::Vector3d sd(params_.speed_sd_m_s, params_.speed_sd_m_s,
                             params_.turn_sd_rad_s * lever);
    common_root_ += dt_s * u * v.cwiseProduct(sd).transpose();
  } else {
    const Eigen::Vector3d w = v.cwiseProduct(Eigen::Vector3d(1.0, 1.0, lever));
    independent_ += w.dot(match.covariance * w) * u * u.transpose();
  }
}

void DisplacementError::add_way(double distance_m, double turn_rad) {
  const double xy = square(params_.drift_m_per_sqrt_m) * distance_m;
  const double theta = square(params_.drift_rad_per_sqrt_m) * distance_m +
                       square(params_.drift_rad_per_sqrt_rad) * std::abs(turn_rad);
  independent_.diagonal() += Eigen::Vector3d(xy, xy, theta);
}

Eigen::Matrix3d DisplacementError::covariance() const {
  Eigen::Matrix3d covariance = independent_ + common_root_ * common_root_.transpose();
  covariance.diagonal() +=
      Eigen::Vector3d(square(params_.floor_m), square(params_.floor_m), square(params_.floor_rad));
  return covariance;
}

}  // namespace adit
