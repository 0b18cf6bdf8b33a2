// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"
#include "common/registration/surfel_map.hpp"
#include "procs/mapping/local_walls.hpp"

namespace adit {

struct WallAgreementParams {
  double reach_m = 0.5;         ///< a wall farther from a point than this has nothing to do with it
  double margin_m = 0.3;        ///< deeper in free space than this contradicts
  double wall_sd_m = 0.04;      ///< distance of a point from its wall where maps coincide
  double stray_share = 0.1;     ///< of the points near a wall that are no part of it all the same
  double contradiction = 0.02;  ///< share of the known points in free space where maps coincide,
  double contradiction_by_chance = 0.5;  ///< and where they do not

  template <class V>
  void visit(V& v) {
    v("reach_m", reach_m, within(0.01, SurfelMap::kReach));
    v("margin_m", margin_m, within(0.0, 10.0));
    v("wall_sd_m", wall_sd_m, within(0.001, 1.0));
    v("stray_share", stray_share, within(0.001, 0.999));
    v("contradiction", contradiction, within(0.001, 0.999));
    v("contradiction_by_chance", contradiction_by_chance, within(0.001, 0.999));
  }
};

/// How the walls of one map lie in another.
struct WallAgreement {
  int points = 0;               ///< that were asked,
  int near = 0;                 ///< those with a wall in reach,
  int contradicting = 0;        ///< and those in the middle of free space; the others are not known
  double log_likelihood = 0.0;  ///< per point, all added: of lying so, against that of chance

  [[nodiscard]] int known() const { return near + contradicting; }
};

/// Asks of each point of `walls`, at `T_reference_walls`, what the reference says of the place: on
/// a wall, off a wall, in free space, or never seen. Two maps of one place seldom contradict each
/// other; two of different places do with every other point.
WallAgreement agreement(const std::vector<SurfacePoint>& points, const Pose2& T_reference_points,
                        const SurfelMap& reference, const std::vector<LocalWalls::View>& views,
                        const WallAgreementParams& params);

}  // namespace adit
