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

  template <class V>
  void visit(V& v) {
    v("filter", filter);
    v("ground_m", ground_m, above(0.0));
    v("ramp_m", ramp_m, above(0.0));
    v("rise_max_m", rise_max_m, above(0.0));
  }
};

/// Estimates roll and pitch of the body from the IMU, and the slope of the ground. The motion of
/// the body, as scan matching measures it, is taken out of the specific force. With a wheel in mud
/// or on a rail, a level laser observes the floor ahead or behind, or the roof: points that move
/// with the body, like a wall that reports no motion.
class BodyAttitude {
 public:
  explicit BodyAttitude(const BodyAttitudeParams& params)
      : params_(params), filter_(params.filter) {}

  /// Ignores readings that do not advance in time or are not finite.
  void add(const ImuReading& reading);
  /// The pose of the body, in order of time.
  void add(std::int64_t utime, const Pose2& T_odom_body);
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
  struct TimedPose {
    std::int64_t utime = 0;
    Pose2 T_odom_body;
  };
  std::deque<TimedPose> poses_;  ///< of the last moments, for the speed
};

}  // namespace adit
