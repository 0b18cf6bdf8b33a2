// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>

#include "common/geometry/pose2.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {

/// T_world_body as a simulator has put it into an LCM log on channel TRUTH, its planar part. A time
/// that comes again or is earlier than one before is left out. Throws std::runtime_error where the
/// log cannot be read or holds no truth.
Trajectory read_ground_truth(const std::filesystem::path& log);

/// Distances between the positions of a trajectory and the true ones at the same times. [m]
struct PositionErrors {
  double rmse_m = 0.0;
  double mean_m = 0.0;
  double max_m = 0.0;
};

/// Errors of the motion over a length of the true way, the same for all stretches of that length.
struct RelativeErrors {
  double length_m = 0.0;
  std::size_t segments = 0;    ///< none where the way is shorter
  double translation_m = 0.0;  ///< mean
  double rotation_deg = 0.0;   ///< mean of the absolute angle
};

/// How good a trajectory is against the truth, over the times that the truth covers (Sturm et al.,
/// "A benchmark for the evaluation of RGB-D SLAM systems", IROS 2012: absolute trajectory error and
/// relative pose error; lengths instead of times as in Geiger et al., "Are we ready for autonomous
/// driving?", CVPR 2012).
struct TrajectoryScore {
  std::size_t poses = 0;
  Pose2 T_world_map;        ///< that brings the positions closest together
  PositionErrors aligned;   ///< by T_world_map
  PositionErrors anchored;  ///< where the first poses are laid upon each other instead
  std::array<RelativeErrors, 3> relative{{{1.0}, {10.0}, {100.0}}};
  double true_length_m = 0.0;
  /// Length of the trajectory over that of the truth, both in steps of half a metre of true way, so
  /// that noise does not count as way. 0 where the way is shorter than that.
  double length_ratio = 0.0;
};

/// Throws std::runtime_error where the truth covers no pose of the trajectory.
TrajectoryScore score_trajectory(const Trajectory& trajectory, const Trajectory& truth);

/// The poses of a trajectory each `step_m` of its way or as soon after as there is one, with the
/// first.
Trajectory downsampled(const Trajectory& trajectory, double step_m);

}  // namespace adit
