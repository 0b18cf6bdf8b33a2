// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

}  // namespace adit
