// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/level_error.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace adit {
namespace {

constexpr double kGate = 18.4;  // chi-square, 2 degrees of freedom, 0.9999

}  // namespace

LevelError::LevelError(double prior_sd_rad)
    : information_(Eigen::Matrix2d::Identity() / (prior_sd_rad * prior_sd_rad)) {}

void LevelError::add(double turn_rad, const Eigen::Vector2d& tilt_rad,
                     const Eigen::Matrix2d& covariance) {
  const Eigen::Matrix2d H =
      Eigen::Rotation2Dd(-turn_rad).toRotationMatrix() - Eigen::Matrix2d::Identity();
  const Eigen::Vector2d innovation = tilt_rad - H * error_rad();
  const Eigen::Matrix2d expected = covariance + H * this->covariance() * H.transpose();
  if (innovation.dot(expected.inverse() * innovation) > kGate) return;
  const Eigen::Matrix2d information = covariance.inverse();
  information_ += H.transpose() * information * H;
  vector_ += H.transpose() * information * tilt_rad;
}

Eigen::Vector2d LevelError::error_rad() const { return covariance() * vector_; }

/// Pitch is positive about y, where the body descends; a body that rolls about x lifts its left.
TiltPrior LevelError::as_prior() const {
  const Eigen::Matrix2d to_heights{{0.0, -1.0}, {1.0, 0.0}};
  return {to_heights * error_rad(), to_heights * covariance() * to_heights.transpose()};
}

}  // namespace adit
