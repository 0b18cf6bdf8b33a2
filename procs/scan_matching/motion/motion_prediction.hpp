// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <optional>

#include "common/config/bounds.hpp"
#include "common/geometry/attitude.hpp"
#include "common/geometry/pose2.hpp"
#include "common/registration/point_to_line.hpp"
#include "common/sensing/vehicle_readings.hpp"
#include "common/sensing/wheel_readings.hpp"

namespace adit {

struct MotionPredictionParams {
  double odometry_sd_m = 0.02;          ///< standard deviation of a step measured by the wheels
  double odometry_sd_per_m = 0.1;       ///< additional, per metre of the step
  double odometry_sd_rad = 0.02;        ///< standard deviation of its rotation
  double odometry_sd_per_rad = 0.1;     ///< additional, per radian of it
  double odometry_sd_rad_per_m = 0.05;  ///< and per metre
  /// Shorter steps have a proportional share of sd_m² and sd_rad².
  double odometry_sd_time_s = 0.2;
  double odometry_gap_max_s = 0.5;  ///< older readings are not extrapolated
  double stationary_s = 0.5;        ///< wheels that have not moved for this long are stationary,
  double stationary_turn_max_rad_s = 0.05;  ///< unless the gyro measures a faster turn
  double gyro_sd_rad_s = 0.01;              ///< standard deviation of the gyro rate, bias included
  double gyro_gap_max_s = 0.2;
  double speed_memory_s = 5.0;     ///< decay time of the speed without sensors
  double turn_memory_s = 0.5;      ///< decay time of the turn rate
  double speed_baseline_s = 0.1;   ///< minimum time over which a speed is measured
  double speed_max_m_s = 1.5;      ///< bounds of motion, whatever the sensors
  double stamp_error_max_s = 0.4;  ///< maximum error of the time between two scans
  double yaw_rate_max_rad_s = 2.0;

  template <class V>
  void visit(V& v) {
    v("odometry_sd_m", odometry_sd_m, within(1e-4, 10.0));
    v("odometry_sd_per_m", odometry_sd_per_m, within(0.0, 10.0));
    v("odometry_sd_rad", odometry_sd_rad, within(1e-4, 10.0));
    v("odometry_sd_per_rad", odometry_sd_per_rad, within(0.0, 10.0));
    v("odometry_sd_rad_per_m", odometry_sd_rad_per_m, within(0.0, 10.0));
    v("odometry_sd_time_s", odometry_sd_time_s, within(1e-3, 60.0));
    v("odometry_gap_max_s", odometry_gap_max_s, within(0.0, 60.0));
    v("stationary_s", stationary_s, within(0.01, 60.0));
    v("stationary_turn_max_rad_s", stationary_turn_max_rad_s, within(0.0, 10.0));
    v("gyro_sd_rad_s", gyro_sd_rad_s, within(1e-5, 10.0));
    v("gyro_gap_max_s", gyro_gap_max_s, within(0.0, 60.0));
    v("speed_memory_s", speed_memory_s, within(0.01, 1000.0));
    v("turn_memory_s", turn_memory_s, within(0.01, 1000.0));
    v("speed_baseline_s", speed_baseline_s, within(0.0, 10.0));
    v("speed_max_m_s", speed_max_m_s, within(0.01, 100.0));
    v("stamp_error_max_s", stamp_error_max_s, within(0.0, 60.0));
    v("yaw_rate_max_rad_s", yaw_rate_max_rad_s, within(0.01, 100.0));
  }
};

/// The prior of a scan's pose, before the scan is matched.
struct MotionEstimate {
  PosePrior prior;             ///< information is zero in unmeasured directions
  bool from_odometry = false;  ///< wheel odometry covers the step
  bool from_gyro = false;      ///< the gyro covers the rotation
  bool stationary = false;     ///< wheels, and the gyro if available, measured no motion
  Pose2 wheels_step;           ///< if from_odometry: the step along the ground, as measured
  /// Last pose; if no wheels measure the step, of the last scan that was located.
  Pose2 T_odom_last;
  double displacement_max_m = 0.0;  ///< maximum displacement since,
  double turn_max_rad = 0.0;        ///< and maximum turn
  /// From the turn by the gyro, where that alone measured it for long: a gyro does not slip.
  double turn_error_max_rad = std::numeric_limits<double>::infinity();
  bool speed_known = false;     ///< the last speed was measured
  double unmeasured_s = 0.0;    ///< time since, if no wheels measure the step
  double unmeasured_m = 0.0;    ///< displacement that is possible in this time,
  double unmeasured_rad = 0.0;  ///< and turn, if no gyro measures it

  /// Whether the body can have reached the pose by now. Rejects matches that jump.
  [[nodiscard]] bool possible(const Pose2& T_odom_body) const;
};

/// Predicts the motion from one matched scan to the next, from wheel odometry and gyro where
/// available, otherwise from the speed of the last step.
class MotionPrediction {
 public:
  explicit MotionPrediction(const MotionPredictionParams& params) : params_(params) {}

  /// False: the reading does not advance in time and is ignored.
  bool add(const WheelOdometry& reading);
  /// `attitude`: of the body then; level where it is unknown.
  bool add(const ImuReading& reading, const Attitude& attitude = {});

  /// Removes all readings: those to come have other times.
  void clear_readings();
  /// Moves the time of the last pose.
  void shift_time(std::int64_t shift_us);

  /// Predicted pose at `utime`, from the last pose given to `correct`. `wheels_scale`: metres in
  /// the level plane for each metre that the wheels measured along the ground.
  [[nodiscard]] MotionEstimate predict(std::int64_t utime, double wheels_scale = 1.0) const;

  /// Sets the pose at `utime`. `measured`: it is observed in all directions, by a match or a
  /// sensor, and updates the speed. A pose that is partly predicted only lets the speed decay.
  /// `located`: a scan was matched; without it and without wheels the body may be farther away with
  /// each scan.
  void correct(std::int64_t utime, const Pose2& T_odom_body, bool measured, bool located = true);

 private:
  struct HeadingRate {
    std::int64_t utime = 0;
    double rad_s = 0.0;
  };

  void apply_odometry(std::int64_t utime, double wheels_scale, MotionEstimate& estimate) const;
  void apply_gyro(std::int64_t utime, MotionEstimate& estimate) const;
  void bound_unmeasured(std::int64_t utime, MotionEstimate& estimate) const;
  [[nodiscard]] std::optional<double> gyro_turn(std::int64_t from, std::int64_t to) const;
  [[nodiscard]] Pose2 step_at_last_speed(double dt_s) const;
  void decay_speed(double dt_s);

  MotionPredictionParams params_;
  WheelReadings wheels_;
  std::deque<HeadingRate> gyro_;
  std::optional<std::int64_t> utime_;
  Pose2 T_odom_body_;
  std::int64_t located_utime_ = 0;  ///< of the last scan that was located
  Pose2 T_odom_located_;
  /// Start of the interval over which the speed is measured.
  std::optional<std::int64_t> speed_utime_;
  Pose2 T_odom_speed_;
  bool speed_known_ = false;
  Eigen::Vector3d speed_body_ = Eigen::Vector3d::Zero();  ///< (m/s, m/s, rad/s)
};

}  // namespace adit
