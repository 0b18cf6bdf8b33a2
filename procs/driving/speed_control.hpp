// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/config/bounds.hpp"
#include "procs/driving/path_run.hpp"

namespace adit {

struct SpeedParams {
  double speed_m_s = 0.4;          ///< where nothing limits it
  double creep_m_s = 0.05;         ///< below which it does not fall but to stand
  double acceleration_m_s2 = 0.2;  ///< planned, and planned to brake with
  double lateral_acceleration_m_s2 = 0.1;
  double clearance_full_m = 0.3;  ///< from which on obstacles beside do not slow it down

  template <class V>
  void visit(V& v) {
    v("speed_m_s", speed_m_s, above(0.0));
    v("creep_m_s", creep_m_s, above(0.0));
    v("acceleration_m_s2", acceleration_m_s2, above(0.0));
    v("lateral_acceleration_m_s2", lateral_acceleration_m_s2, above(0.0));
    v("clearance_full_m", clearance_full_m, above(0.0));
  }
};

/// How fast a run is to be driven, to a stand at its end: no faster than curvature, obstacles
/// beside and the steering allow, and so that braking suffices for what comes.
class SpeedProfile {
 public:
  /// `steering_rate_1_m_s` is the greatest change of the curvature per second.
  SpeedProfile(const PathRun& run, const SpeedParams& params, double speed_max_m_s,
               double steering_rate_1_m_s);

  /// At a place of the run, without direction: at least creeping, 0 at its end and behind.
  [[nodiscard]] double at(double s_m) const;

 private:
  double spacing_m_;
  double creep_m_s_;
  std::vector<double> squares_;  ///< of the speed, between which it is linear where it brakes
};

/// What the vehicle is told, so that it can follow: speed grows and curvature changes no faster
/// than given; it slows down at once, as the vehicle brakes harder than is planned. From a stand it
/// drives off when it has stood for a while and is steered.
class CommandRamp {
 public:
  CommandRamp(double acceleration_m_s2, double steering_rate_1_m_s)
      : acceleration_m_s2_(acceleration_m_s2), steering_rate_1_m_s_(steering_rate_1_m_s) {}

  /// For the next `seconds`; a speed to the other side than the present one means to stand first.
  void drive(double speed_m_s, double curvature_1_m, double seconds);
  /// The steering stays.
  void stop(double seconds);

  /// Long enough for the vehicle to stand, too.
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
