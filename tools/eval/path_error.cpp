// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/eval/path_error.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace adit {

std::vector<PosePair> pose_pairs(const Trajectory& trajectory, const Trajectory& reference) {
  std::vector<PosePair> pairs;
  for (const auto& [utime, pose] : trajectory) {
    if (const auto T_reference = interpolate(reference, utime)) {
      pairs.push_back({pose, *T_reference});
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

PositionErrors position_errors(const std::vector<PosePair>& pairs,
                               const Pose2& T_reference_trajectory) {
  PositionErrors errors;
  double squares = 0.0;
  for (const auto& [estimate, reference] : pairs) {
    const double distance_m =
        (T_reference_trajectory * estimate.translation() - reference.translation()).norm();
    squares += distance_m * distance_m;
    errors.mean_m += distance_m;
    errors.max_m = std::max(errors.max_m, distance_m);
  }
  errors.rmse_m = std::sqrt(squares / static_cast<double>(pairs.size()));
  errors.mean_m /= static_cast<double>(pairs.size());
  return errors;
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
