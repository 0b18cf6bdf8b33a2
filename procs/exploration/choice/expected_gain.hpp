// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config/bounds.hpp"
#include "common/types/exploration.hpp"
#include "procs/exploration/map/drivable_space.hpp"

namespace adit {

struct ExpectedGainParams {
  double prior_m = 20.0;      ///< of corridor behind a stub, before any was seen
  double prior_weight = 5.0;  ///< as many corridors as that is worth
  double lookahead_m = 40.0;  ///< how far ahead known space makes a loop likely
  double gain_min_m = 10.0;   ///< what closing any stub is worth
  double loop_factor = 5.0;   ///< metres of corridor that closing a loop is worth, per metre of sd

  template <class V>
  void visit(V& v) {
    v("prior_m", prior_m, above(0.0));
    v("prior_weight", prior_weight, at_least(0.0));
    v("lookahead_m", lookahead_m, at_least(0.0));
    v("gain_min_m", gain_min_m, above(0.0));
    v("loop_factor", loop_factor, at_least(0.0));
  }
};

/// Mean length of the corridors seen so far from junction to junction or to a dead end [m].
double mean_corridor_m(const CorridorGraph& corridors, const ExpectedGainParams& params);

/// New corridor to be expected at a stub [m]: what corridors are long on the average, or as far as
/// to known space straight ahead. There a loop will close, which is worth more the less certain the
/// pose is.
double expected_gain_m(const Frontier& frontier, const DrivableSpace& space, double mean_m,
                       double sd_m, const ExpectedGainParams& params);

}  // namespace adit
