// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"
#include "common/registration/point_to_line.hpp"
#include "common/sensing/vehicle_readings.hpp"

namespace adit {

/// Readings in order of time.
using WheelReadings = std::deque<WheelOdometry>;

/// T_wheel_body at `utime`: between readings by interpolation, after the last one at its speed;
/// nothing before the first and where the last is older than `gap_max_s`.
std::optional<Pose2> wheel_pose_at(const WheelReadings& wheels, std::int64_t utime,
                                   double gap_max_s);

/// Have the wheels not moved from `since` until the last reading? Since before the last pose, for
/// odometry that repeats itself for a moment is not enough. No where there is no reading so old.
bool wheels_stationary(const WheelReadings& wheels, std::int64_t since);

struct MotionPredictionParams {
  double odometry_sd_m = 0.02;              ///< of a step that the wheels report
  double odometry_sd_per_m = 0.1;           ///< more for each metre of it
  double odometry_sd_rad = 0.02;            ///< of its rotation
  double odometry_sd_per_rad = 0.1;         ///< more for each radian of it
  double odometry_sd_rad_per_m = 0.05;      ///< and for each metre
  double odometry_sd_time_s = 0.2;          ///< a shorter step has its share of sd_m² and sd_rad²
  double odometry_gap_max_s = 0.5;          ///< older readings say nothing of now
  double stationary_s = 0.5;                ///< wheels that have not moved for this long stand,
  double stationary_turn_max_rad_s = 0.05;  ///< unless the gyro says that the body turns
  double gyro_sd_rad_s = 0.01;              ///< of the gyro's rate, bias included
  double gyro_gap_max_s = 0.2;
  double speed_memory_s = 5.0;     ///< without sensors a speed dies away in this time
  double turn_memory_s = 0.5;      ///< and a turn in this
  double speed_baseline_s = 0.1;   ///< no speed is taken from a shorter time
  double speed_max_m_s = 1.5;      ///< bounds of what is believed without any sensor
  double stamp_error_max_s = 0.4;  ///< how far apart the stamps of two scans may be wrong
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

/// Where the body is expected to be before the laser is asked, and how far to trust it.
struct MotionEstimate {
  PosePrior prior;                  ///< information is zero in what no sensor measured
  bool from_odometry = false;       ///< wheels covered the step
  bool from_gyro = false;           ///< the gyro covered the rotation
  bool stationary = false;          ///< wheels, and gyro where there is one, measured no motion
  Pose2 T_odom_last;                ///< where the body was
  double displacement_max_m = 0.0;  ///< how far it can have come since,
  double turn_max_rad = 0.0;        ///< and turned

  /// Can the body be there by now? Matches that jump cannot.
  [[nodiscard]] bool possible(const Pose2& T_odom_body) const;
};

/// Predicts the motion from one matched scan to the next, by wheel odometry and gyro where they
/// are, otherwise by the speed of the last step.
class MotionPrediction {
 public:
  explicit MotionPrediction(const MotionPredictionParams& params) : params_(params) {}

  /// Readings that do not advance in time are refused: false.
  bool add(const WheelOdometry& reading);
  bool add(const ImuReading& reading);

  /// Expected pose at `utime`, from the last pose given to `correct`.
  [[nodiscard]] MotionEstimate predict(std::int64_t utime) const;

  /// The pose at `utime` is now known; `measured`: in all directions, by a match or a sensor, so
  /// that its speed means something. What was predicted in part only lets the last speed die away.
  void correct(std::int64_t utime, const Pose2& T_odom_body, bool measured);

 private:
  void apply_odometry(std::int64_t utime, MotionEstimate& estimate) const;
  void apply_gyro(std::int64_t utime, MotionEstimate& estimate) const;
  [[nodiscard]] std::optional<double> gyro_turn(std::int64_t from, std::int64_t to) const;
  [[nodiscard]] Pose2 step_at_last_speed(double dt_s) const;
  void decay_speed(double dt_s);

  MotionPredictionParams params_;
  WheelReadings wheels_;
  std::deque<ImuReading> imu_;
  std::optional<std::int64_t> utime_;
  Pose2 T_odom_body_;
  std::optional<std::int64_t> speed_utime_;  ///< since when, and from where, a speed is measured
  Pose2 T_odom_speed_;
  Eigen::Vector3d speed_body_ = Eigen::Vector3d::Zero();  ///< (m/s, m/s, rad/s)
};

}  // namespace adit
