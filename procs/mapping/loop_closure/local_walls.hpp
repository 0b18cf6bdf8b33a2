// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <limits>
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

/// The mount of each laser, by the channel of its scans.
using LaserMounts = std::map<std::string, LaserMount, std::less<>>;

struct LocalWallsParams {
  SurfaceParams surface;
  double spacing_m = 0.1;        ///< distance between points of a wall
  double range_max_m = 30.0;     ///< points farther away are discarded
  double wall_sd_m = 0.01;       ///< standard deviation of the mean of a wall
  double view_distance_m = 1.0;  ///< motion between two stored views of the free space,
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

/// A point of the traversed path in a local map.
struct TraversedPoint {
  Eigen::Vector3d p;       ///< of the body [m]
  double forward_m = 0.0;  ///< travelled forwards from the origin, less that backwards
};

/// The walls and free space of a local map, in its frame, as matching uses them.
struct LocalWalls {
  /// The free space of a scan; few such views cover nearly all the observed space.
  struct View {
    FreeSpace free_space;
    Pose2 T_local_body;
  };

  std::vector<SurfacePoint> points;
  double length_m = 0.0;  ///< approximate total length of the walls
  std::vector<View> views;
  std::vector<TraversedPoint> path;
};

/// Extracts the walls of a local map, without what may be ground or roof. Scans on a channel
/// without a mount are ignored.
LocalWalls local_walls(const LocalMap& map, const LaserMounts& mounts,
                       const LocalWallsParams& params);

/// The height of one map above another that shows the same place.
struct GroundOffset {
  double offset_m = std::numeric_limits<double>::quiet_NaN();
  double distance_m = 2.0;  ///< in plan, between the points that were compared
  /// Travelled forwards from the origins of both maps to the points that give the offset; a pitch
  /// error acts along it.
  double reference_forward_m = 0.0;
  double path_forward_m = 0.0;
};

/// From the ground that both maps drove on: the median where their paths are nearest to each other.
/// NaN if they do not come within 2 m.
GroundOffset ground_offset(const std::vector<TraversedPoint>& path, const Pose2& T_reference_path,
                           const std::vector<TraversedPoint>& path_reference);

struct WallAgreementParams {
  /// Maximum distance between a point and its wall.
  double wall_distance_max_m = 0.5;
  double margin_m = 0.3;        ///< a point deeper in free space is a contradiction
  double wall_sd_m = 0.04;      ///< standard deviation of the distance between a point and its wall
                                ///< where maps coincide
  double stray_share = 0.1;     ///< share of points near a wall that do not belong to it
  double contradiction = 0.02;  ///< share of the observed points in free space where maps coincide,
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

/// The agreement of the walls of one map with another map.
struct WallAgreement {
  int points = 0;               ///< all points,
  int near = 0;                 ///< those with a wall in reach,
  int contradicting = 0;        ///< and those in free space; the others lie in unobserved space
  double log_likelihood = 0.0;  ///< sum over the points: against that of points placed by chance

  [[nodiscard]] int observed() const { return near + contradicting; }
};

/// Classifies each of the `points`, at `T_reference_points`, in the reference: on a wall, near a
/// wall, in free space, or unobserved. `z_reference_points_m`: height of their map; NaN if unknown,
/// which is taken as the same height everywhere. Two maps of one place rarely contradict each
/// other; maps of different places do with every second point.
WallAgreement agreement(const std::vector<SurfacePoint>& points, const Pose2& T_reference_points,
                        const SurfelMap& reference, const std::vector<LocalWalls::View>& views,
                        const WallAgreementParams& params, double z_reference_points_m = 0.0);

/// Of each point, at `T_reference_points`, that has a wall of the reference in reach and a normal:
/// by how much it is before this wall, towards where it was seen from [m].
std::vector<double> distances_before_walls(const std::vector<SurfacePoint>& points,
                                           const Pose2& T_reference_points,
                                           const SurfelMap& reference, double distance_max_m);

}  // namespace adit
