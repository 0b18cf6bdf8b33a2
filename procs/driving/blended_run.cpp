// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/blended_run.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace adit {
namespace {

constexpr double kKnotM = 0.05;
constexpr int kSamples = 8;  // to either side, of a mean

/// By the rule of trapezoids. Headings of a run are not wrapped.
Pose2 mean_pose(const PathRun& run, double s_m, double half_m) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = -kSamples; i <= kSamples; ++i) {
    const double weight = std::abs(i) == kSamples ? 0.5 : 1.0;
    sum += weight * run.at(s_m + half_m * i / kSamples).vector();
  }
  const Eigen::Vector3d mean = sum / (2.0 * kSamples);
  return {mean.x(), mean.y(), mean.z()};
}

}  // namespace

PathRun blended(const PathRun& run, double blend_m) {
  const int pieces = static_cast<int>(std::ceil(run.length_m() / kKnotM));
  std::vector<PathRun::Knot> knots;
  for (int i = 0; i <= pieces; ++i) {
    const double s_m = pieces > 0 ? run.length_m() * i / pieces : 0.0;
    const double half_m = std::min({blend_m / 2.0, s_m, run.length_m() - s_m});
    PathRun::Knot knot{0.0, mean_pose(run, s_m, half_m), run.clearance_m(s_m)};
    if (i > 0) {
      const Pose2& last = knots.back().T_odom_steered;
      knot.s_m = knots.back().s_m + (knot.T_odom_steered.translation() - last.translation()).norm();
    }
    knots.push_back(knot);
  }
  return {std::move(knots), run.direction() < 0.0};
}

}  // namespace adit
