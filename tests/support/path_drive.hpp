// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "procs/driving/driving.hpp"
#include "sim/vehicle/vehicle_params.hpp"
#include "tests/support/late_poses.hpp"

namespace adit {

struct PathDriveSetup {
  DrivingParams driving;
  VehicleModelParams motion;
  PoseNoise noise;
  std::uint64_t seed = 1;
  double poses_end_m = 1e9;  ///< of the way, from which on no pose comes any more
};

/// What became of a drive.
struct PathDrive {
  DrivingState::Kind end = DrivingState::Kind::kDriving;
  std::string reason;
  double seconds = 0.0;
  double travelled_m = 0.0;
  std::vector<double> lateral_m;  ///< of the true body's origin from the path, each 2 cm of the way
  Pose2 T_end_body;               ///< of the body at last, from the end of the path
  double swings_per_m = 0.0;      ///< from 3 cm on one side to 3 cm on the other, after a metre
  double steering_rms_1_m_s = 0.0;  ///< rate of the curvature that is commanded, while it moves
  double without_poses_m = 0.0;     ///< driven after the last pose came
  double speed_then_m_s = 0.0;      ///< when it came
};

/// Drives the simulated vehicle along a path on an even floor, from a stand at the origin of odom,
/// which is world. At most 60 m from there. Ends where driving arrives or fails, five seconds after
/// the last pose, or after ten minutes.
PathDrive drive_path(const PlannedPath& path, const PathDriveSetup& setup);

/// The value that a share of the magnitudes does not exceed; 0 of none.
double quantile(std::vector<double> values, double share);

}  // namespace adit
