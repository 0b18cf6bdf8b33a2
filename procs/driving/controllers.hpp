// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config/bounds.hpp"
#include "common/types/driving_state.hpp"
#include "procs/driving/path_run.hpp"

namespace adit {

struct LateralParams {
  double response_m = 0.8;  ///< distance over which an error falls to about a third
  double damping = 1.0;     ///< 1 is critical damping: the fastest without overshoot

  template <class V>
  void visit(V& v) {
    v("response_m", response_m, within(0.1, 10.0));
    v("damping", damping, within(0.3, 3.0));
  }
};

/// PD control of the lateral error (section 3.3 of the paper), with the curvature of the path as
/// feed-forward, over distance instead of time: the behaviour is the same at every speed.
///
/// Over its travelled distance σ the steered point moves by e_y' = d sin e_θ and turns by
/// e_θ' = d (κ − κ_f), where d is 1, or −1 in reverse, and κ_f = κ_path cos e_θ / (1 − κ_path e_y)
/// keeps e_θ constant. The returned curvature yields, without approximation,
///   e_y'' + 2 ζ ω e_y' + ω² e_y = 0,   ω = 1 / response.
/// Where the curvature is clamped to that of the vehicle, the error falls more slowly. A constant
/// `drift_rad` (DriftAngle) is compensated: e_y' = d sin(e_θ + drift).
double lateral_curvature(const PathTrackingError& error, double path_curvature_1_m,
                         double direction, const LateralParams& params, double drift_rad = 0.0);

struct PurePursuitParams {
  double lookahead_s = 2.0;  ///< look-ahead distance over the current speed
  double lookahead_min_m = 0.8;
  double lookahead_max_m = 1.2;

  template <class V>
  void visit(V& v) {
    v("lookahead_s", lookahead_s, at_least(0.0));
    v("lookahead_min_m", lookahead_min_m, above(0.0));
    v("lookahead_max_m", lookahead_max_m, above(0.0));
  }
};

/// Pure pursuit (Coulter, CMU-RI-TR-92-01): the curvature of the arc from the steered point to the
/// point of the path at the look-ahead distance. That distance increases with the speed, as in
/// Macenski et al., "Regulated pure pursuit for robot path tracking", 2023. The speed is regulated
/// by the SpeedProfile, as with the PD controller.
double pursuit_curvature(const PathRun& run, double s_m, const Pose2& T_odom_steered,
                         double speed_m_s, const PurePursuitParams& params);

}  // namespace adit
