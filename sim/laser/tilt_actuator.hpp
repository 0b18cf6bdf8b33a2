// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "common/config/bounds.hpp"
#include "common/sensing/laser_tilt.hpp"

namespace adit {

/// Time-optimal motion in one dimension from a position and rate to rest at a goal, within limits
/// of rate and acceleration (trapezoidal rate profile). It overshoots and reverses only if the
/// initial rate is too high to stop at the goal.
class TrapezoidalMotion {
 public:
  struct State {
    double position = 0.0;
    double rate = 0.0;
  };

  /// At rest.
  explicit TrapezoidalMotion(double position) : start_{position, 0.0}, goal_(position) {}
  /// The limits must be positive.
  TrapezoidalMotion(const State& start, double goal, double rate_max, double acceleration);

  [[nodiscard]] State at(double seconds) const;  ///< after the start of the motion of the motion

 private:
  State start_;
  double goal_;
  double direction_ = 1.0;  ///< sign of the rate after an initial reversal
  double peak_rate_ = 0.0;  ///< along `direction_`
  double acceleration_ = 1.0;
  double to_peak_s_ = 0.0;
  double at_peak_s_ = 0.0;
};

struct TiltParams {
  double angle_min_rad = -0.524;  ///< looking up
  double angle_max_rad = 0.524;   ///< looking down
  double rate_max_rad_s = 0.5;
  double acceleration_rad_s2 = 2.0;
  double encoder_step_rad = 0.0001;  ///< resolution of the angle that is reported

  template <class V>
  void visit(V& v) {
    v("angle_min_rad", angle_min_rad, within(-1.5, 0.0));
    v("angle_max_rad", angle_max_rad, within(0.0, 1.5));
    v("rate_max_rad_s", rate_max_rad_s, above(0.0));
    v("acceleration_rad_s2", acceleration_rad_s2, above(0.0));
    v("encoder_step_rad", encoder_step_rad, at_least(0.0));
  }
};

/// The motor that tilts a laser. It moves to the last commanded angle within its limits of angle,
/// rate and acceleration, without overshoot, and holds it. Level at the start.
class TiltActuator {
 public:
  explicit TiltActuator(const TiltParams& params) : params_(params) {}

  /// Goals are clamped to the limits. A command with a value that is not finite or a rate that is
  /// not positive is ignored; the motor then continues to its previous goal.
  void command(const TiltCommand& command);
  void advance(double seconds);

  [[nodiscard]] double angle_rad() const { return state().position; }  ///< true
  [[nodiscard]] double rate_rad_s() const { return state().rate; }
  /// The angle as measured by the encoder.
  [[nodiscard]] TiltReading reading(std::int64_t utime) const;

 private:
  [[nodiscard]] TrapezoidalMotion::State state() const { return motion_.at(since_command_s_); }

  TiltParams params_;
  TrapezoidalMotion motion_{0.0};
  double since_command_s_ = 0.0;
};

}  // namespace adit
