// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/eval/path_error.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace adit {

std::vector<PosePair> pose_pairs(const Trajectory& trajectory, const Trajectory& reference) {
  std::vector<PosePair> pairs;
  for (const TimedPose& at : trajectory) {
    if (const auto true_at = interpolate_in_space(reference, at.utime)) {
      pairs.push_back({at.pose, true_at->pose, at.z_m, true_at->z_m});
    }
  }
  return pairs;
}

Pose2 align(const std::vector<PosePair>& pairs) {
  Eigen::Vector2d mean_estimate = Eigen::Vector2d::Zero();
  Eigen::Vector2d mean_reference = Eigen::Vector2d::Zero();
  for (const PosePair& pair : pairs) {
    mean_estimate += pair.estimate.translation();
    mean_reference += pair.reference.translation();
  }
  mean_estimate /= static_cast<double>(pairs.size());
  mean_reference /= static_cast<double>(pairs.size());

  double dot = 0.0;
  double cross = 0.0;
  for (const PosePair& pair : pairs) {
    const Eigen::Vector2d a = pair.estimate.translation() - mean_estimate;
    const Eigen::Vector2d b = pair.reference.translation() - mean_reference;
    dot += a.dot(b);
    cross += a.x() * b.y() - a.y() * b.x();
  }
  const Pose2 rotation{0.0, 0.0, std::atan2(cross, dot)};
  const Eigen::Vector2d translation = mean_reference - rotation * mean_estimate;
  return {translation.x(), translation.y(), rotation.theta};
}

std::optional<Pose2> align(const Trajectory& trajectory, const Trajectory& reference) {
  const auto pairs = pose_pairs(trajectory, reference);
  if (pairs.empty()) return std::nullopt;
  return align(pairs);
}

namespace {

void add_error(double error_m, AxisErrors& sums) {
  sums.rmse_m += error_m * error_m;
  sums.max_m = std::max(sums.max_m, std::abs(error_m));
}

}  // namespace

PositionErrors position_errors(const std::vector<PosePair>& pairs,
                               const Pose2& T_reference_trajectory, double rise_m) {
  PositionErrors errors;
  double squares = 0.0;
  for (const PosePair& pair : pairs) {
    const Eigen::Vector2d error =
        T_reference_trajectory * pair.estimate.translation() - pair.reference.translation();
    const double distance_m = error.norm();
    squares += distance_m * distance_m;
    errors.mean_m += distance_m;
    errors.max_m = std::max(errors.max_m, distance_m);
    add_error(error.x(), errors.x);
    add_error(error.y(), errors.y);
    add_error(pair.z_estimate_m + rise_m - pair.z_reference_m, errors.z);
  }
  const auto count = static_cast<double>(pairs.size());
  errors.rmse_m = std::sqrt(squares / count);
  errors.mean_m /= count;
  for (AxisErrors* axis : {&errors.x, &errors.y, &errors.z}) {
    axis->rmse_m = std::sqrt(axis->rmse_m / count);
  }
  return errors;
}

double mean_rise_m(const std::vector<PosePair>& pairs) {
  double sum = 0.0;
  for (const PosePair& pair : pairs) sum += pair.z_reference_m - pair.z_estimate_m;
  return sum / static_cast<double>(pairs.size());
}

PathError path_error(const Trajectory& trajectory, const Trajectory& reference) {
  const auto pairs = pose_pairs(trajectory, reference);
  if (pairs.empty()) return {};
  const PositionErrors errors = position_errors(pairs, align(pairs));
  PathError error{pairs.size(), errors.rmse_m, errors.max_m};
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    const Pose2 step = between(pairs[i - 1].estimate, pairs[i].estimate);
    const Pose2 true_step = between(pairs[i - 1].reference, pairs[i].reference);
    error.step_m = std::max(error.step_m, between(true_step, step).translation().norm());
  }
  return error;
}

double longest_step_m(const Trajectory& trajectory) {
  double longest = 0.0;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    const auto step = between(trajectory[i - 1].pose, trajectory[i].pose);
    longest = std::max(longest, step.translation().norm());
  }
  return longest;
}

}  // namespace adit
