// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_matching/open_directions.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr double kSpeedSdM = 0.2;  // how far a body may depart from its last speed in one step
constexpr double kSpeedSdRad = 0.2;

/// Information of what is expected along a direction: the sensors', or else that a speed lasts.
double expected_information(const Eigen::Vector3d& direction, const MotionEstimate& expected,
                            double lever_arm) {
  const Eigen::Vector3d to_radians(1.0, 1.0, 1.0 / lever_arm);
  const Eigen::Vector3d v = direction.cwiseProduct(to_radians);
  const Eigen::Vector3d variances(kSpeedSdM * kSpeedSdM, kSpeedSdM * kSpeedSdM,
                                  kSpeedSdRad * kSpeedSdRad);
  return v.dot(expected.prior.information * v) + v.dot(v.cwiseQuotient(variances));
}

}  // namespace

DegenerateDirection::Fill fill_of(const Eigen::Vector3d& direction,
                                  const MotionEstimate& expected) {
  const bool mostly_turn = std::abs(direction.z()) > 0.7;
  if (expected.from_gyro && mostly_turn) return DegenerateDirection::Fill::kImu;
  if (expected.from_odometry) return DegenerateDirection::Fill::kOdometry;
  return DegenerateDirection::Fill::kNone;
}

Eigen::Matrix3d reach_information(const MotionEstimate& expected) {
  const double m = std::max(expected.reach_m, 1e-3);
  const double rad = std::max(expected.reach_rad, 1e-3);
  return Eigen::Vector3d(1.0 / (m * m), 1.0 / (m * m), 1.0 / (rad * rad)).asDiagonal();
}

Pose2 fill_open(const Pose2& T_odom_body, const MotionEstimate& expected,
                const std::vector<OpenDirection>& open, double lever_arm) {
  const Eigen::Vector3d scale(1.0, 1.0, lever_arm);
  const Eigen::Vector3d off =
      between(T_odom_body, expected.prior.T_odom_body).vector().cwiseProduct(scale);
  Eigen::Vector3d back = Eigen::Vector3d::Zero();
  for (const auto& [v, information] : open) {
    const double prior = expected_information(v, expected, lever_arm);
    back += v * v.dot(off) * prior / (prior + information);
  }
  return T_odom_body * Pose2::from_vector(back.cwiseQuotient(scale));
}

}  // namespace adit
