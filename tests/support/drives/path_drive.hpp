// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "common/geometry/pose2.hpp"
#include "procs/driving/driving.hpp"
#include "sim/vehicle/vehicle_params.hpp"

namespace adit {

/// How poses depart from the truth, beside coming late.
struct PoseNoise {
  double white_m = 0.02;  ///< of each pose, x and y each
  double white_rad = 0.0087;
  double drift_m = 0.02;  ///< varying over `drift_time_constant_s`
  double drift_rad = 0.0087;
  double drift_time_constant_s = 5.0;
  std::int64_t delay_us = 30'000;

  /// None but the delay.
  static PoseNoise none() { return {0.0, 0.0, 0.0, 0.0, 5.0, 30'000}; }
};

/// Poses as scan matching might give them: at the rate of an LMS-200 at half a degree, late and
/// with noise.
class DelayedNoisyPoses {
 public:
  DelayedNoisyPoses(const PoseNoise& noise, std::uint64_t seed);

  /// To be told the truth at each step of time.
  void add_true_pose(std::int64_t utime, const Pose2& T_odom_body);
  /// Those that have come by now, in order.
  void deliver(std::int64_t utime,
               const std::function<void(std::int64_t utime, const Pose2& T_odom_body)>& take);

 private:
  struct TruePose {
    std::int64_t utime;
    Pose2 T_odom_body;
  };

  PoseNoise noise_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  std::array<double, 3> drift_{};  ///< standard normal
  std::int64_t next_utime_ = 0;
  std::deque<TruePose> pending_;
};

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
  double distance_travelled_m = 0.0;
  std::vector<double>
      cross_track_error_m;  ///< of the true body's origin from the path, each 2 cm of the way
  Pose2 T_end_body;         ///< of the body at last, from the end of the path
  double oscillations_per_m = 0.0;  ///< from 3 cm on one side to 3 cm on the other, after a metre
  double steering_rms_1_m_s = 0.0;  ///< rate of the curvature that is commanded, while it moves
  double distance_without_poses_m = 0.0;  ///< driven after the last pose came
  double speed_at_last_pose_m_s = 0.0;    ///< when it came
};

/// Drives the simulated vehicle along a path on an even floor, from a stand at the origin of odom,
/// which is world. At most 60 m from there. Ends where driving arrives or fails, five seconds after
/// the last pose, or after ten minutes.
PathDrive drive_path(const PlannedPath& path, const PathDriveSetup& setup);

/// The value that a share of the magnitudes does not exceed; 0 of none.
double quantile(std::vector<double> values, double share);

}  // namespace adit
