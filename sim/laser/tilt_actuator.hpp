// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "common/config/bounds.hpp"
#include "common/sensing/laser_tilt.hpp"

namespace adit {

/// The quickest way along a line from a place and rate to rest at another place, within limits of
/// rate and acceleration: the rate over time is a trapezoid. Turns round where it is already too
/// fast to stop in time, and only then goes beyond the goal.
class TrapezoidalMotion {
 public:
  struct State {
    double position = 0.0;
    double rate = 0.0;
  };

  /// At rest, for ever.
  explicit TrapezoidalMotion(double position) : start_{position, 0.0}, goal_(position) {}
  /// Limits are positive.
  TrapezoidalMotion(const State& start, double goal, double rate_max, double acceleration);

  [[nodiscard]] State at(double seconds) const;  ///< after the start

 private:
  State start_;
  double goal_;
  double direction_ = 1.0;  ///< of the motion after turning round, if it must
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

/// The motor that tilts a laser: goes to where it was last told, within its limits of angle, rate
/// and acceleration, without overshoot, and stays there. Level at first.
class TiltActuator {
 public:
  explicit TiltActuator(const TiltParams& params) : params_(params) {}

  /// A goal beyond the limits becomes the limit. A command of a number that is not finite, or of a
  /// rate that is not positive, is ignored: the motor goes on to where it was told before.
  void command(const TiltCommand& command);
  void advance(double seconds);

  [[nodiscard]] double angle_rad() const { return state().position; }  ///< true
  [[nodiscard]] double rate_rad_s() const { return state().rate; }
  /// What its encoder says.
  [[nodiscard]] TiltReading reading(std::int64_t utime) const;

 private:
  [[nodiscard]] TrapezoidalMotion::State state() const { return motion_.at(since_command_s_); }

  TiltParams params_;
  TrapezoidalMotion motion_{0.0};
  double since_command_s_ = 0.0;
};

}  // namespace adit
