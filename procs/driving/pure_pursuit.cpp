// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/pure_pursuit.hpp"

#include <algorithm>
#include <cmath>

namespace adit {

double pursuit_curvature(const PathRun& run, double s_m, const Pose2& T_odom_steered,
                         double speed_m_s, const PursuitParams& params) {
  const double most = std::max(params.lookahead_min_m, params.lookahead_max_m);
  const double ahead =
      std::clamp(params.lookahead_s * std::abs(speed_m_s), params.lookahead_min_m, most);
  const Pose2 T_steered_target = between(T_odom_steered, run.at(s_m + ahead));
  return 2.0 * T_steered_target.y / T_steered_target.translation().squaredNorm();
}

}  // namespace adit
