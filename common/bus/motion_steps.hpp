// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string_view>

#include "common/geometry/pose2.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/sensing/scan_match.hpp"
#include "common/sensing/vehicle_readings.hpp"

namespace adit {

/// A pose of a vehicle in a stream of them.
struct StreamPose {
  std::int64_t utime = 0;  ///< [µs since the epoch]
  Pose2 T_frame_body;
  double z_m = 0.0;
  std::int64_t frame_utime = 0;  ///< time at which the frame began, 0 if unknown [µs]
};

inline StreamPose stream_pose(const StampedPose& pose) {
  return {pose.utime, pose.T_odom_body, pose.z_m};
}
inline StreamPose stream_pose(const WheelOdometry& odometry) {
  return {odometry.utime, odometry.T_wheel_body};
}
inline StreamPose stream_pose(const ScanMatch& match) {
  return {match.utime, match.T_odom_body, match.z_m, match.odom_epoch_utime};
}

/// Monitors the poses that one subscription receives. One that no vehicle reaches from the pose
/// before is rejected: in the time between their stamps, and in that between their arrivals, since
/// a stamp may be wrong too. When the poses continue from there, the frame was corrected or reset,
/// as after a restart of its sender, and they are followed; within a known frame only a
/// correction that a search can have found, since a map that was built in it cannot follow a
/// farther one.
class MotionSteps {
 public:
  static constexpr std::string_view kTooFar = "a step that no vehicle makes";
  static constexpr double kSpeedMaxM_s = 10.0;
  static constexpr double kTurnMaxRad_s = 10.0;
  static constexpr double kCorrectionM = 0.5;    ///< in any time
  static constexpr double kCorrectionRad = 0.5;  ///< in any time
  static constexpr double kFoundMaxM = 100.0;    ///< of a lasting step within a known frame
  static constexpr int kLastingLength = 3;       ///< poses from which a step is followed

  /// Returns the reason for rejection, or an empty text. `arrival_utime`: bus time at its arrival
  /// [µs since the epoch].
  std::string_view check(const StreamPose& pose, std::int64_t arrival_utime);

 private:
  /// Poses that follow each other.
  struct Run {
    StreamPose last;
    std::int64_t last_arrival_utime = 0;
    int length = 0;

    [[nodiscard]] bool is_followed_by(const StreamPose& pose, std::int64_t arrival_utime) const;
    void add(const StreamPose& pose, std::int64_t arrival_utime);
  };

  [[nodiscard]] bool can_be_followed(const StreamPose& pose) const;

  Run accepted_;
  Run rejected_;  // since the last one that was accepted
};

}  // namespace adit
