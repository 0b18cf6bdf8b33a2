// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/geometry/attitude.hpp"
#include "common/geometry/pose2.hpp"
#include "common/registration/surface_points.hpp"
#include "common/sensing/attitude_filter.hpp"
#include "common/sensing/vehicle_readings.hpp"

namespace adit {

struct BodyAttitudeParams {
  AttitudeFilterParams filter{.settling_s = 3.0, .deviation_max_m_s2 = 0.5, .bias_s = 20.0};
  /// Path lengths over which the mean slope is taken as that of the ground: the longer one does not
  /// follow a wheel on a rail, the shorter one follows a ramp.
  double ground_m = 10.0;
  double ramp_m = 2.0;
  double rise_max_m = 0.4;  ///< maximum change of a beam's height above the ground
  /// Of the body; beyond, a match is wrong and not used. Brakes reach 0.8 m/s².
  double acceleration_max_m_s2 = 1.0;

  template <class V>
  void visit(V& v) {
    v("filter", filter);
    v("ground_m", ground_m, above(0.0));
    v("ramp_m", ramp_m, above(0.0));
    v("rise_max_m", rise_max_m, above(0.0));
    v("acceleration_max_m_s2", acceleration_max_m_s2, at_least(0.0));
  }
};

/// Speed and acceleration along the body's x axis, from the poses of the last moments.
class RecentMotion {
 public:
  struct Motion {
    double speed_m_s = 0.0;
    double acceleration_m_s2 = 0.0;  ///< between the means of two intervals of 0.3 s
  };

  /// In order of time.
  void add(std::int64_t utime, const Pose2& T_frame_body);
  /// Nothing after a gap, and without poses of the last 0.6 s.
  [[nodiscard]] std::optional<Motion> at(std::int64_t utime) const;

 private:
  struct TimedPose {
    std::int64_t utime = 0;
    Pose2 T_frame_body;
  };
  std::deque<TimedPose> poses_;
};

/// Estimates roll and pitch of the body from the IMU, and the slope of the ground. The motion of
/// the body is taken out of the specific force, as far as scan matching and wheels agree on it: a
/// wrong match would tilt the body, which makes the next match worse. With a wheel in mud
/// or on a rail, a level laser observes the floor ahead or behind, or the roof: points that move
/// with the body, like a wall that reports no motion.
class BodyAttitude {
 public:
  explicit BodyAttitude(const BodyAttitudeParams& params)
      : params_(params), filter_(params.filter) {}

  /// Ignores readings that do not advance in time or are not finite.
  void add(const ImuReading& reading);
  /// The pose of the body, in order of time.
  void add(std::int64_t utime, const Pose2& T_odom_body) { matched_.add(utime, T_odom_body); }
  void add(const WheelOdometry& reading) { wheels_.add(reading.utime, reading.T_wheel_body); }
  /// Reports the distance driven since the last call.
  void drive(double distance_m);

  /// Nothing without an IMU, or if it measured nothing like gravity for 10 s.
  [[nodiscard]] std::optional<Attitude> attitude() const;

  /// Whether a beam of a laser at `laser_m` above the origin of the body ends near this height
  /// above the ground there, by one of the mean slopes. True while the attitude is unknown.
  [[nodiscard]] bool is_level_at(const SurfacePoint& point, double laser_m) const;

 private:
  [[nodiscard]] Eigen::Vector3d acceleration(const ImuReading& reading) const;

  BodyAttitudeParams params_;
  AttitudeFilter filter_;
  std::int64_t utime_ = 0;
  struct MeanSlopes {
    Eigen::Vector2d ground;  ///< along x and y of level [m/m]
    Eigen::Vector2d ramp;
  };
  std::optional<MeanSlopes> slopes_;
  RecentMotion matched_;
  RecentMotion wheels_;
};

}  // namespace adit
