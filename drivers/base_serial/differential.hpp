// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>

#include "common/geometry/pose2.hpp"

namespace adit {

/// Speeds of the wheels of both sides along the ground [m/s].
struct SideSpeeds {
  double left_m_s = 0.0;
  double right_m_s = 0.0;
};

/// Speeds for a motion of the middle between both sides. Faster ones than `speed_max_m_s` are
/// reduced on both sides, which keeps the curvature.
SideSpeeds side_speeds(double speed_m_s, double curvature_1_m, double track_width_m,
                       double speed_max_m_s);

/// Pose and speed from the encoders of a base whose sides have their own speeds (Siegwart,
/// Nourbakhsh, Scaramuzza, "Introduction to Autonomous Mobile Robots", section 5.2.4), each step an
/// arc. Counters of ticks overflow.
class DifferentialOdometry {
 public:
  DifferentialOdometry(double track_width_m, double ticks_per_m)
      : track_width_m_(track_width_m), ticks_per_m_(ticks_per_m) {}

  /// Counters at a time of the base [µs], later than those before.
  void add(std::int64_t device_us, std::int32_t left_ticks, std::int32_t right_ticks);

  /// The counters start again: what the base moved until the next ones is not counted.
  void interrupt() { samples_.clear(); }

  /// How far the faster side moved from the last counters to these [m].
  [[nodiscard]] double moved_m(std::int32_t left_ticks, std::int32_t right_ticks) const;

  /// Of the body in the frame wheel; its heading is not wrapped.
  [[nodiscard]] const Pose2& T_wheel_body() const { return T_wheel_body_; }

  /// Means of the last tenth of a second.
  [[nodiscard]] double speed_m_s() const { return speed_m_s_; }
  [[nodiscard]] double yaw_rate_rad_s() const { return yaw_rate_rad_s_; }

 private:
  struct Sample {
    std::int64_t device_us = 0;
    std::int32_t left_ticks = 0;
    std::int32_t right_ticks = 0;
  };
  struct Step {
    double length_m = 0.0;
    double turn_rad = 0.0;
  };
  [[nodiscard]] Step step(const Sample& from, const Sample& to) const;

  double track_width_m_;
  double ticks_per_m_;
  std::deque<Sample> samples_;  ///< of the last tenth of a second
  Pose2 T_wheel_body_;
  double speed_m_s_ = 0.0;
  double yaw_rate_rad_s_ = 0.0;
};

}  // namespace adit
