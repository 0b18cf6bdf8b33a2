// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config/bounds.hpp"
#include "procs/driving/path_run.hpp"

namespace adit {

struct PursuitParams {
  double lookahead_s = 2.0;  ///< of the way at the present speed
  double lookahead_min_m = 0.8;
  double lookahead_max_m = 1.2;

  template <class V>
  void visit(V& v) {
    v("lookahead_s", lookahead_s, at_least(0.0));
    v("lookahead_min_m", lookahead_min_m, above(0.0));
    v("lookahead_max_m", lookahead_max_m, above(0.0));
  }
};

/// Pure pursuit (Coulter, CMU-RI-TR-92-01): the curvature of the arc that leads the steered point
/// to the path's place some way ahead; that way grows with the speed, as in Macenski et al.,
/// "Regulated pure pursuit for robot path tracking", 2023. What regulates the speed is the profile
/// that the other controller has, too.
double pursuit_curvature(const PathRun& run, double s_m, const Pose2& T_odom_steered,
                         double speed_m_s, const PursuitParams& params);

}  // namespace adit
