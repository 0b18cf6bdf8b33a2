// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config/bounds.hpp"
#include "common/types/exploration.hpp"
#include "procs/exploration/map/drivable_space.hpp"

namespace adit {

struct ExpectedGainParams {
  double prior_m = 20.0;      ///< length of corridor behind a frontier, before any is mapped
  double prior_weight = 5.0;  ///< weight of the prior, in corridors
  double lookahead_m = 40.0;  ///< distance of known space ahead up to which a loop is likely
  double gain_min_m = 10.0;   ///< least gain of a frontier
  double loop_factor = 5.0;   ///< gain of a loop closure [m per m of position sd]

  template <class V>
  void visit(V& v) {
    v("prior_m", prior_m, above(0.0));
    v("prior_weight", prior_weight, at_least(0.0));
    v("lookahead_m", lookahead_m, at_least(0.0));
    v("gain_min_m", gain_min_m, above(0.0));
    v("loop_factor", loop_factor, at_least(0.0));
  }
};

/// Mean length [m] of the corridors mapped so far between junctions and dead ends, with the prior.
double mean_corridor_m(const CorridorGraph& corridors, const ExpectedGainParams& params);

/// Expected length of new corridor behind a frontier [m]: the mean corridor, or the distance to
/// known space straight ahead. In the latter case a loop closure is expected, whose gain grows with
/// the standard deviation of the position.
double expected_gain_m(const Frontier& frontier, const DrivableSpace& space, double mean_m,
                       double sd_m, const ExpectedGainParams& params);

}  // namespace adit
