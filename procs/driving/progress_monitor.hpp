// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "common/config/bounds.hpp"
#include "common/geometry/attitude.hpp"
#include "common/geometry/pose2.hpp"
#include "common/sensing/scan_match.hpp"
#include "common/types/driving_state.hpp"
#include "common/types/vehicle_state.hpp"

namespace adit {

/// Detects a vehicle that has been held for longer than a timeout. A hold may be released for a
/// centimetre and set again: only progress restarts the timeout.
class HoldTimeout {
 public:
  static constexpr double kProgressM = 0.05;  ///< progress that restarts the timeout

  explicit HoldTimeout(double seconds_max) : seconds_max_(seconds_max) {}

  /// `distance_m` is the distance travelled on the path. Called while the robot drives or is held.
  void update(std::int64_t utime, double distance_m, bool held);
  void reset() { since_utime_.reset(); }

  [[nodiscard]] bool is_exceeded() const { return exceeded_; }

 private:
  double seconds_max_;
  std::optional<std::int64_t> since_utime_;  ///< first hold after the distance below
  double distance_m_ = 0.0;
  bool exceeded_ = false;
};

/// The commanded distance since the motion was last observed in every direction by a scan, or by
/// wheels or a gyroscope in its place. Along an unobserved direction the pose stands still, and the
/// robot would never arrive.
class UnobservedMotion {
 public:
  /// Only matched scans count.
  void add_match(const ScanMatch& match);
  /// Adds a commanded distance [m], in either direction.
  void add_drive(double distance_m);
  void reset() { distance_m_ = 0.0; }

  [[nodiscard]] double distance_m() const { return distance_m_; }

 private:
  bool unobserved_ = false;
  double distance_m_ = 0.0;
};

/// The difference between the distances by wheel odometry and by poses since the start of a path.
/// Between smooth walls a tilted laser that sees the floor may report that the robot stands while
/// it drives: the robot would drive beyond the end of its path, into ground that was not scanned.
/// Or the wheels spin, and the robot lags behind. A rescan resolves both.
class OdometryMismatch {
 public:
  /// Starts again after a gap of the vehicle states.
  void add_state(const VehicleState& state);
  /// Starts again if the vehicle states are stale.
  void add_pose(std::int64_t utime, const Pose2& T_odom_body, const Attitude& attitude = {});
  void reset() { *this = {}; }

  /// Positive if the distance by the wheels is larger [m].
  [[nodiscard]] double difference_m() const { return wheels_m_ - pose_m_; }
  /// Distance by the wheels, forwards plus in reverse [m].
  [[nodiscard]] double distance_travelled_m() const { return distance_travelled_m_; }

 private:
  std::optional<VehicleState> state_;
  std::optional<Pose2> T_odom_body_;
  double wheels_m_ = 0.0;
  double pose_m_ = 0.0;
  double distance_travelled_m_ = 0.0;
};

/// Limits beyond which a path is abandoned and the robot needs a new one.
struct ProgressLimits {
  double distance_max_m = 0.35;               ///< from the path
  double heading_max_rad = 0.5;               ///< from the direction of the path
  double hold_timeout_s = 10.0;               ///< of a vehicle that is held without progress
  double unobserved_distance_max_m = 5.0;     ///< without an observation of the motion
  double odometry_mismatch_max_m = 0.2;       ///< between wheels and poses, since the start
  double odometry_mismatch_max_share = 0.08;  ///< plus this share of the distance travelled

  template <class V>
  void visit(V& v) {
    v("distance_max_m", distance_max_m, above_up_to(0.0, 2.0));
    v("heading_max_rad", heading_max_rad, above_up_to(0.0, 1.2));
    v("hold_timeout_s", hold_timeout_s, within(1.0, 600.0));
    v("unobserved_distance_max_m", unobserved_distance_max_m, above(0.0));
    v("odometry_mismatch_max_m", odometry_mismatch_max_m, above(0.0));
    v("odometry_mismatch_max_share", odometry_mismatch_max_share, within(0.0, 10.0));
  }
};

/// Decides whether the robot still makes progress on its path.
class ProgressMonitor {
 public:
  explicit ProgressMonitor(const ProgressLimits& limits)
      : limits_(limits), hold_timeout_(limits.hold_timeout_s) {}

  void add_pose(std::int64_t utime, const Pose2& T_odom_body, const Attitude& attitude = {});
  void add_state(const VehicleState& state) { odometry_mismatch_.add_state(state); }
  void add_match(const ScanMatch& match) { unobserved_.add_match(match); }
  void add_drive(double distance_m) { unobserved_.add_drive(distance_m); }

  /// A new path.
  void reset();
  /// The robot neither drives nor is held.
  void reset_hold() { hold_timeout_.reset(); }

  /// The state of the robot on its path.
  struct Tracking {
    double distance_m = 0.0;  ///< from the path
    PathTrackingError error;  ///< only the heading counts
    double distance_travelled_m = 0.0;
    std::optional<std::string> hold_reason;  ///< why the vehicle is held
  };
  /// Why the path must be abandoned; nothing if it need not be.
  std::optional<std::string> failure_reason(std::int64_t utime, const Tracking& tracking);

 private:
  ProgressLimits limits_;
  HoldTimeout hold_timeout_;
  UnobservedMotion unobserved_;
  OdometryMismatch odometry_mismatch_;
};

}  // namespace adit
