// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/config/bounds.hpp"
#include "procs/driving/path_run.hpp"

namespace adit {

struct SpeedParams {
  double speed_m_s = 0.5;   ///< desired speed
  double creep_m_s = 0.05;  ///< minimum speed of a moving robot
  double acceleration_m_s2 = 0.3;
  double braking_m_s2 = 0.5;  ///< planned; the guard relies on 0.6
  double lateral_acceleration_m_s2 = 0.14;
  double clearance_full_m = 0.15;  ///< clearance from which on the speed is not reduced
  /// Clearance at which the robot creeps, as errors of the path and of the steering take it. The
  /// margin of the guard, which grows with the speed, leaves it.
  double clearance_creep_m = 0.03;

  template <class V>
  void visit(V& v) {
    v("speed_m_s", speed_m_s, above(0.0));
    v("creep_m_s", creep_m_s, above(0.0));
    v("acceleration_m_s2", acceleration_m_s2, above(0.0));
    v("braking_m_s2", braking_m_s2, above(0.0));
    v("lateral_acceleration_m_s2", lateral_acceleration_m_s2, above(0.0));
    v("clearance_full_m", clearance_full_m, above(0.0));
    v("clearance_creep_m", clearance_creep_m, at_least(0.0));
  }
};

/// Share of the full speed that a clearance allows: 1 from `clearance_full_m` on, 0 where the robot
/// creeps.
double clearance_share(double clearance_m, const SpeedParams& params);

/// The speed over a run, down to zero at its end: limited by curvature, clearance and steering
/// rate, and by the braking distance to each later limit.
class SpeedProfile {
 public:
  /// `steering_rate_1_m_s` is the maximum rate of change of the curvature.
  SpeedProfile(const PathRun& run, const SpeedParams& params, double speed_max_m_s,
               double steering_rate_1_m_s);

  /// Absolute speed at an arc length: at least `creep_m_s`, 0 at the end of the run and beyond.
  [[nodiscard]] double at(double s_m) const;

 private:
  double spacing_m_;
  double creep_m_s_;
  std::vector<double> squares_;  ///< of the speed; linear between samples while braking
};

/// Rate limiter of the commands: the vehicle can follow its speed and curvature. The speed falls
/// immediately, as the vehicle brakes harder than planned. From standstill it starts only after a
/// pause, and when the curvature is set.
class CommandRamp {
 public:
  CommandRamp(double acceleration_m_s2, double steering_rate_1_m_s)
      : acceleration_m_s2_(acceleration_m_s2), steering_rate_1_m_s_(steering_rate_1_m_s) {}

  /// The desired motion for the next `seconds`. A speed opposite to the current one stops first.
  void drive(double speed_m_s, double curvature_1_m, double seconds);
  /// Stops and keeps the curvature.
  void stop(double seconds);

  /// Whether the command has been zero for long enough that the vehicle stands.
  [[nodiscard]] bool has_stopped() const;
  /// Negative in reverse.
  [[nodiscard]] double speed_m_s() const { return speed_m_s_; }
  [[nodiscard]] double curvature_1_m() const { return curvature_1_m_; }

 private:
  double acceleration_m_s2_;
  double steering_rate_1_m_s_;
  double speed_m_s_ = 0.0;
  double curvature_1_m_ = 0.0;
  double stopped_s_ = 0.0;
};

}  // namespace adit
