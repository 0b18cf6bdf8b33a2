// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"
#include "common/registration/free_space.hpp"
#include "common/registration/surface_points.hpp"
#include "common/registration/surfel_map.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/types/local_map.hpp"

namespace adit {

/// Where each laser sits, by the channel of its scans.
using LaserMounts = std::map<std::string, LaserMount, std::less<>>;

struct LocalWallsParams {
  SurfaceParams surface;
  double spacing_m = 0.1;        ///< between the points of a wall
  double range_max_m = 30.0;     ///< what was seen farther away is left out
  double wall_sd_m = 0.01;       ///< how far the mean of a wall may be from where it is
  double view_distance_m = 1.0;  ///< way from one kept view of the free space to the next,
  double view_angle_rad = 0.8;   ///< or turn

  template <class V>
  void visit(V& v) {
    v("surface", surface);
    v("spacing_m", spacing_m, within(0.01, 1.0));
    v("range_max_m", range_max_m, within(1.0, 1000.0));
    v("wall_sd_m", wall_sd_m, within(0.001, 1.0));
    v("view_distance_m", view_distance_m, above(0.0));
    v("view_angle_rad", view_angle_rad, above(0.0));
  }
};

/// What matching needs of a local map, in its frame: the walls it saw, thinned out, and the space
/// that it saw to be free.
struct LocalWalls {
  /// A scan's free space, chosen so that few of them see nearly all that all saw.
  struct View {
    FreeSpace free_space;
    Pose2 T_local_body;
  };

  std::vector<SurfacePoint> points;
  double length_m = 0.0;  ///< of the walls together, about
  std::vector<View> views;
};

/// Scans on a channel without a mount are left out: the caller has made sure that there are none.
LocalWalls local_walls(const LocalMap& map, const LaserMounts& mounts,
                       const LocalWallsParams& params);

struct WallAgreementParams {
  /// A wall farther from a point than this has nothing to do with it.
  double wall_distance_max_m = 0.5;
  double margin_m = 0.3;        ///< deeper in free space than this contradicts
  double wall_sd_m = 0.04;      ///< distance of a point from its wall where maps coincide
  double stray_share = 0.1;     ///< of the points near a wall that are no part of it all the same
  double contradiction = 0.02;  ///< share of the known points in free space where maps coincide,
  double contradiction_by_chance = 0.5;  ///< and where they do not

  template <class V>
  void visit(V& v) {
    v("wall_distance_max_m", wall_distance_max_m, within(0.01, SurfelMap::kReach));
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
