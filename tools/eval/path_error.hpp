// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "common/geometry/pose2.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {

/// Poses of a trajectory and a reference at the same time.
struct PosePair {
  Pose2 estimate;
  Pose2 reference;
  double z_estimate_m = 0.0;
  double z_reference_m = 0.0;
};

/// A pair for each pose whose time the reference covers, with the reference interpolated.
std::vector<PosePair> pose_pairs(const Trajectory& trajectory, const Trajectory& reference);

/// The rigid transform T_reference_trajectory that minimises the squared distances of the positions
/// (Umeyama, "Least-squares estimation of transformation parameters between two point patterns",
/// PAMI 1991, without scale). `pairs` must not be empty.
Pose2 align(const std::vector<PosePair>& pairs);
/// Nothing if the reference covers no pose.
std::optional<Pose2> align(const Trajectory& trajectory, const Trajectory& reference);

/// Errors along one axis of the reference.
struct AxisErrors {
  double rmse_m = 0.0;
  double max_m = 0.0;  ///< of the absolute error
};

/// Distances between estimated and reference positions in plan, and the errors along each axis.
struct PositionErrors {
  double rmse_m = 0.0;
  double mean_m = 0.0;
  double max_m = 0.0;
  AxisErrors x = {};
  AxisErrors y = {};
  AxisErrors z = {};
};
/// `pairs` must not be empty. `rise_m` is the height of the origin of the trajectory in the
/// reference.
PositionErrors position_errors(const std::vector<PosePair>& pairs,
                               const Pose2& T_reference_trajectory, double rise_m = 0.0);

/// Mean height of the reference above the trajectory. `pairs` must not be empty.
double mean_rise_m(const std::vector<PosePair>& pairs);

/// Error of a trajectory against a reference, after alignment. All zero if the reference covers no
/// pose.
struct PathError {
  std::size_t poses = 0;  ///< with a time that the reference covers
  double rmse_m = 0.0;
  double farthest_m = 0.0;  ///< largest position error
  double step_m = 0.0;      ///< largest translation error between consecutive poses
};
PathError path_error(const Trajectory& trajectory, const Trajectory& reference);

/// Largest distance between consecutive poses. [m]
double longest_step_m(const Trajectory& trajectory);

}  // namespace adit
