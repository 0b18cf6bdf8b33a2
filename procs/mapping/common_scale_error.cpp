// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/common_scale_error.hpp"

#include <algorithm>

namespace adit {

WheelScaleError moved(const Eigen::Matrix3d& effect, WheelScaleError error) {
  error.error = effect * error.error;
  return error;
}

/// If both cancel, nothing of what the covariance contains is taken for common.
WheelScaleError composed(const WheelScaleError& first, const WheelScaleError& second,
                         const Eigen::Matrix3d& to_second) {
  const Eigen::Vector3d of_first = moved(to_second, first).error;
  WheelScaleError both{of_first + second.error, std::max(first.scale_sd, second.scale_sd), 0.0};
  const double squared = both.error.head<2>().squaredNorm();
  if (!(squared > 0.0)) return both;
  const double contained = first.times * of_first.head<2>().squaredNorm() +
                           second.times * second.error.head<2>().squaredNorm();
  both.times = std::min(contained / squared, std::max(first.times, second.times));
  return both;
}

/// Σ min(sᵢ, sⱼ)² bᵢ bⱼᵀ with b the effect of a scale of 1, by the sums over all that are at least
/// as uncertain; without the squares that the covariance contains.
Eigen::Matrix3d common_scale_covariance(std::vector<WheelScaleError> errors) {
  std::erase_if(errors, [](const WheelScaleError& e) { return !(e.scale_sd > 0.0); });
  std::ranges::stable_sort(errors, {}, &WheelScaleError::scale_sd);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const WheelScaleError& e : errors) sum += e.error / e.scale_sd;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double variance = 0.0;
  for (const WheelScaleError& e : errors) {
    const double own = e.scale_sd * e.scale_sd;
    covariance += (own - variance) * sum * sum.transpose();
    covariance -= e.times * e.error * e.error.transpose();
    variance = own;
    sum -= e.error / e.scale_sd;
  }
  return covariance;
}

}  // namespace adit
