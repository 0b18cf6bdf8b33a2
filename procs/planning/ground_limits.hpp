// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config/bounds.hpp"

namespace adit {

/// What ground is refused, beyond what the shape of the vehicle says, and what it costs.
struct GroundLimits {
  double step_margin_m = 0.03;       ///< below Vehicle::step_max_m that a wheel is led over
  double belly_margin_m = 0.03;      ///< below Vehicle::belly_clearance_m
  double roof_margin_m = 0.15;       ///< above Vehicle::height_m: a wheel on a rail lifts a corner
  double slope_max_rad = 0.35;       ///< of ground under the wheels
  double unseen_roughness = 0.5;     ///< of ground that was not seen, 0 (even) to 1 (at the limit)
  double blind_beside_m = 0.4;       ///< the robot, unseen: its tail swings by 0.3 m at most
  double blind_ahead_m = 1.2;        ///< likewise before an end of it
  double blind_margin_m = 0.8;       ///< to either side of that, beyond its width
  double repulsion_roughness = 0.4;  ///< of even ground that repels as a step at the limit does

  template <class V>
  void visit(V& v) {
    v("step_margin_m", step_margin_m, at_least(0.0));
    v("belly_margin_m", belly_margin_m, at_least(0.0));
    v("roof_margin_m", roof_margin_m, at_least(0.0));
    v("slope_max_rad", slope_max_rad, above(0.0));
    v("unseen_roughness", unseen_roughness, within(0.0, 1.0));
    v("blind_beside_m", blind_beside_m, at_least(0.0));
    v("blind_ahead_m", blind_ahead_m, at_least(0.0));
    v("blind_margin_m", blind_margin_m, at_least(0.0));
    v("repulsion_roughness", repulsion_roughness, within(0.0, 1.0));
  }
};

}  // namespace adit
