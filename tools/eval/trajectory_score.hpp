// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>

#include "common/geometry/pose2.hpp"
#include "tools/eval/path_error.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {

/// Position and heading of T_world_body from TRUTH of an LCM log of the simulator. Poses whose time
/// does not increase are skipped. Throws std::runtime_error if the log cannot be read or has no
/// TRUTH.
Trajectory read_ground_truth(const std::filesystem::path& log);

/// Mean errors of the motion over segments of a given length of the true path.
struct RelativeErrors {
  double length_m = 0.0;
  std::size_t segments = 0;    ///< 0 if the path is shorter
  double translation_m = 0.0;  ///< mean
  double rotation_deg = 0.0;   ///< mean of the absolute angle
};

/// Errors that are allowed at a distance from the start of a mission, in space [m].
struct AllowedErrors {
  static constexpr double kAtStartM = 0.05;
  static constexpr double kPlanShare = 0.0002;
  static constexpr double kHeightShare = 0.0003;

  double plan_m = kAtStartM;
  double height_m = kAtStartM;
};
AllowedErrors allowed_errors(double distance_from_start_m);

/// Error of a trajectory against the truth, over the times that the truth covers (Sturm et al.,
/// "A benchmark for the evaluation of RGB-D SLAM systems", IROS 2012: absolute trajectory error and
/// relative pose error; lengths instead of times as in Geiger et al., "Are we ready for autonomous
/// driving?", CVPR 2012).
struct TrajectoryScore {
  std::size_t poses = 0;
  bool heights =
      false;          ///< whether the trajectory has heights, without which those errors are void
  Pose2 T_world_map;  ///< alignment with the least squared distances
  PositionErrors aligned;   ///< by T_world_map
  PositionErrors anchored;  ///< with the first poses aligned instead
  /// Root mean square of the anchored errors divided by the allowed ones: up to 1 is accurate.
  double plan_of_allowed = 0.0;
  double height_of_allowed = 0.0;
  std::array<RelativeErrors, 3> relative{{{1.0}, {10.0}, {100.0}}};
  double true_length_m = 0.0;
  /// Length of the trajectory divided by that of the truth, both in steps of 0.5 m of the true
  /// path, so that noise adds no length. 0 for a shorter path.
  double length_ratio = 0.0;
};

/// Throws std::runtime_error if the truth covers no pose of the trajectory.
TrajectoryScore score_trajectory(const Trajectory& trajectory, const Trajectory& truth);

/// The first pose of a trajectory, and the next pose after each `step_m` of its path length.
Trajectory downsampled(const Trajectory& trajectory, double step_m);

}  // namespace adit
