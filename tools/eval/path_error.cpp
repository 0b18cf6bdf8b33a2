// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/eval/path_error.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace adit {
namespace {

/// One pose as both have it.
struct Pair {
  Pose2 found;
  Pose2 reference;
};

std::vector<Pair> pairs_of(const Trajectory& trajectory, const Trajectory& reference) {
  std::vector<Pair> pairs;
  for (const auto& [utime, pose] : trajectory) {
    if (const auto there = interpolate(reference, utime)) pairs.push_back({pose, *there});
  }
  return pairs;
}

Pose2 align(const std::vector<Pair>& pairs) {
  Eigen::Vector2d mean_found = Eigen::Vector2d::Zero();
  Eigen::Vector2d mean_reference = Eigen::Vector2d::Zero();
  for (const Pair& pair : pairs) {
    mean_found += pair.found.translation();
    mean_reference += pair.reference.translation();
  }
  mean_found /= static_cast<double>(pairs.size());
  mean_reference /= static_cast<double>(pairs.size());

  double along = 0.0;
  double across = 0.0;
  for (const Pair& pair : pairs) {
    const Eigen::Vector2d a = pair.found.translation() - mean_found;
    const Eigen::Vector2d b = pair.reference.translation() - mean_reference;
    along += a.dot(b);
    across += a.x() * b.y() - a.y() * b.x();
  }
  const Pose2 turn{0.0, 0.0, std::atan2(across, along)};
  const Eigen::Vector2d shift = mean_reference - turn * mean_found;
  return {shift.x(), shift.y(), turn.theta};
}

}  // namespace

std::optional<Pose2> align(const Trajectory& trajectory, const Trajectory& reference) {
  const auto pairs = pairs_of(trajectory, reference);
  if (pairs.empty()) return std::nullopt;
  return align(pairs);
}

PathError path_error(const Trajectory& trajectory, const Trajectory& reference) {
  const auto pairs = pairs_of(trajectory, reference);
  if (pairs.empty()) return {};
  const Pose2 T_reference_found = align(pairs);
  PathError error;
  error.poses = pairs.size();
  double squares = 0.0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto& [found, reference_pose] = pairs[i];
    const double distance_m =
        (T_reference_found * found.translation() - reference_pose.translation()).norm();
    squares += distance_m * distance_m;
    error.farthest_m = std::max(error.farthest_m, distance_m);
    if (i == 0) continue;
    const Pose2 step = between(pairs[i - 1].found, found);
    const Pose2 true_step = between(pairs[i - 1].reference, reference_pose);
    error.step_m = std::max(error.step_m, between(true_step, step).translation().norm());
  }
  error.rmse_m = std::sqrt(squares / static_cast<double>(pairs.size()));
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
