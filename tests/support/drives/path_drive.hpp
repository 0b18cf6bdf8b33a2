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

/// Noise and delay of simulated pose estimates.
struct PoseNoise {
  double white_m = 0.02;  ///< standard deviation of x and of y, independent for each pose
  double white_rad = 0.0087;
  double drift_m = 0.02;  ///< of the time-correlated error, with `drift_time_constant_s`
  double drift_rad = 0.0087;
  double drift_time_constant_s = 5.0;
  std::int64_t delay_us = 30'000;

  /// No noise, but the default delay.
  static PoseNoise none() { return {0.0, 0.0, 0.0, 0.0, 5.0, 30'000}; }
};

/// Pose estimates with the statistics of scan matching: the rate of an LMS-200 at 0.5°, delayed and
/// noisy.
class DelayedNoisyPoses {
 public:
  DelayedNoisyPoses(const PoseNoise& noise, std::uint64_t seed);

  /// Must be called with the true pose at each time step.
  void add_true_pose(std::int64_t utime, const Pose2& T_odom_body);
  /// Passes the poses whose delay has elapsed to `take`, in order.
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
  double poses_end_m = 1e9;  ///< distance travelled after which no poses arrive
};

/// The result of a drive.
struct PathDrive {
  DrivingState::Kind end = DrivingState::Kind::kDriving;
  std::string reason;
  double seconds = 0.0;
  double distance_travelled_m = 0.0;
  std::vector<double> cross_track_error_m;  ///< of the true body origin, every 2 cm travelled
  Pose2 T_end_body;                         ///< final body pose relative to the end of the path
  /// Changes of side by more than 3 cm on both sides, per metre, after the first metre.
  double oscillations_per_m = 0.0;
  double steering_rms_1_m_s = 0.0;        ///< rate of the commanded curvature while moving
  double distance_without_poses_m = 0.0;  ///< travelled after the last pose
  double speed_at_last_pose_m_s = 0.0;    ///< speed at the time of the last pose
};

/// Drives the simulated vehicle along a path on an even floor, from rest at the origin of odom,
/// which equals world. The path must stay within 60 m of the origin. The drive ends when driving
/// arrives or fails, five seconds after the last pose, or after ten minutes.
PathDrive drive_path(const PlannedPath& path, const PathDriveSetup& setup);

/// Quantile of the absolute values; `share` is from 0 to 1. 0 if there are no values.
double absolute_quantile(std::vector<double> values, double share);

}  // namespace adit
