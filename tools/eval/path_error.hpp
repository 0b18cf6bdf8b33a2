// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "common/geometry/pose2.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {

/// How far a trajectory is from a reference, over the poses whose times the reference covers.
struct PathError {
  std::size_t poses = 0;
  double rmse_m = 0.0;      ///< of the positions, after alignment
  double farthest_m = 0.0;  ///< position, after alignment
  double step_m = 0.0;      ///< largest error of the motion from one pose to the next
};

/// The rigid motion that takes the trajectory's frame to that of the reference so that positions
/// lie closest together, in the sense of least squares (Umeyama, "Least-squares estimation of
/// transformation parameters between two point patterns", PAMI 1991, without scale). Nothing where
/// no time is covered.
std::optional<Pose2> align(const Trajectory& trajectory, const Trajectory& reference);

/// All zero where no time is covered.
PathError path_error(const Trajectory& trajectory, const Trajectory& reference);

/// Length of the longest step from one pose to the next. [m]
double longest_step_m(const Trajectory& trajectory);

}  // namespace adit
