// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_matching/motion/laser_disagreement.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

constexpr double kStaleMemories = 3.0;  // a laser that matched nothing for so long is no witness

}  // namespace

/// Where the prediction knows more than the match, the pose follows it, and the laser would seem to
/// contradict another one that measures the error of the wheels.
Eigen::Vector2d LaserDisagreement::witnessed(LaserId laser, const Eigen::Vector2d& correction_m,
                                             const Eigen::Matrix2d& match,
                                             const Eigen::Matrix2d& prior) const {
  const auto other =
      std::ranges::find_if(means_, [&](const auto& mean) -> bool { return mean.first != laser; });
  if (other == means_.end()) return correction_m;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> shares(match, prior);
  const Eigen::Matrix2d& axes = shares.eigenvectors();  // axesᵀ prior axes = 1
  Eigen::Vector2d along = axes.transpose() * prior * correction_m;
  const Eigen::Vector2d others = axes.transpose() * prior * other->second.correction_m;
  for (int i = 0; i < 2; ++i) {
    if (shares.eigenvalues()[i] < 1.0) along[i] = others[i];
  }
  return axes * along;
}

Eigen::Vector2d LaserDisagreement::error_m(std::int64_t utime) const {
  const auto front = means_.find(LaserId::kFront);
  const auto rear = means_.find(LaserId::kRear);
  if (front == means_.end() || rear == means_.end()) return Eigen::Vector2d::Zero();
  const auto oldest = std::min(front->second.utime, rear->second.utime);
  if (seconds(utime - oldest) > kStaleMemories * params_.memory_s) return Eigen::Vector2d::Zero();
  return 0.5 * (front->second.correction_m - rear->second.correction_m);
}

Pose2 LaserDisagreement::fuse(LaserId laser, std::int64_t utime, const MotionEstimate& expected,
                              const Pose2& T_odom_match, Eigen::Matrix3d& information) {
  if (!expected.from_odometry) return T_odom_match;
  const Eigen::Matrix3d& prior = expected.prior.information;
  const Eigen::Vector3d correction = between(expected.prior.T_odom_body, T_odom_match).vector();
  const auto [entry, is_new] = means_.try_emplace(laser);
  Mean& mean = entry->second;
  const double dt_s = is_new ? 0.0 : seconds(utime - mean.utime);
  mean.correction_m +=
      (1.0 - std::exp(-dt_s / params_.memory_s)) * (correction.head<2>() - mean.correction_m);
  mean.correction_m = witnessed(laser, mean.correction_m, information.topLeftCorner<2, 2>(),
                                prior.topLeftCorner<2, 2>());
  mean.utime = utime;

  // It lasts for the scans of the memory and adds up over them, where noise averages.
  const double scans = dt_s > 0.0 ? std::max(1.0, params_.memory_s / dt_s) : 1.0;
  const Eigen::Vector2d error = std::sqrt(scans) * error_m(utime);
  if (error.isZero(0.0)) return T_odom_match;
  // The covariance of the match alone becomes C + e eᵀ (Sherman and Morrison 1950).
  const Eigen::Vector3d e(error.x(), error.y(), 0.0);
  const Eigen::Vector3d Ie = information * e;
  const Eigen::Matrix3d reduction = Ie * e.transpose() / (1.0 + e.dot(Ie));
  const Eigen::Vector3d pull = (information + prior) * correction;
  information -= reduction * information;
  const Eigen::Vector3d fused = (information + prior).ldlt().solve(pull - reduction * pull);
  return expected.prior.T_odom_body * Pose2::from_vector(fused);
}

}  // namespace adit
