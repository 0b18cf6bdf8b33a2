// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config/bounds.hpp"
#include "common/path/driving_state.hpp"

namespace adit {

struct LateralParams {
  double response_m = 0.8;  ///< way in which an error falls to a third or so
  double damping = 1.0;     ///< 1 is critical: the fastest without overshoot

  template <class V>
  void visit(V& v) {
    v("response_m", response_m, within(0.1, 10.0));
    v("damping", damping, within(0.3, 3.0));
  }
};

/// PD control of the way beside a path (the paper's section 3.3), with the path's own curvature
/// fed forward, in distance instead of time: the same at every speed and at a stand.
///
/// Along its own way σ the steered point moves by e_y' = d sin e_θ and turns by e_θ' = d (κ − κ_f),
/// where d is 1, or −1 in reverse, and κ_f = κ_path cos e_θ / (1 − κ_path e_y) is what holds e_θ.
/// The curvature returned makes of that, without any approximation,
///   e_y'' + 2 ζ ω e_y' + ω² e_y = 0,   ω = 1 / response.
/// Where it is clamped to what the vehicle can do, the error falls more slowly.
double lateral_curvature(const TrackError& error, double path_curvature_1_m, double direction,
                         const LateralParams& params);

}  // namespace adit
