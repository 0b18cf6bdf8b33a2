// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"
#include "common/registration/correlative_search.hpp"
#include "common/registration/degeneracy.hpp"
#include "common/registration/point_to_line.hpp"
#include "common/types/association.hpp"
#include "procs/mapping/loop_closure/local_walls.hpp"

namespace adit {

struct MapMatchingParams {
  CorrelativeSearchParams search{.cell_m = 0.15,
                                 .angle_step_rad = 0.0262,
                                 .points_max = 100,
                                 .blocks_max = 60000,
                                 .peak_separation_cells = 6,
                                 .score_min = 0.3};
  PointToLineParams refinement{.scale_start_m = 0.3, .scale_end_m = 0.06};
  WallAgreementParams agreement;
  DegeneracyParams degeneracy;
  double gate_sigmas = 4.0;    ///< alternatives farther from the prediction are discarded
  double radius_max_m = 20.0;  ///< maximum half-width of the search
  int peaks = 20;              ///< number of correlation peaks that are refined
  int points_max = 500;        ///< maximum number of points of the newer map
  /// Minimum share of the newer map's points in observed space of the older map.
  double observed_share_min = 0.3;
  double on_wall_share_min = 0.7;  ///< minimum share of these on walls instead of in free space
  double independent_m = 1.5;      ///< length of wall that counts as one independent observation
  /// Minimum log-likelihood; chance gives less at the many poses tried.
  double log_likelihood_min = 5.0;
  double correlated_points = 5.0;  ///< number of neighbouring points that share one error
  /// Minimum standard deviation of a match: local maps are not rigid, and show rough walls at
  /// different heights. Measured in simulated mines: 8 mm on level ground, 12 mm on slopes.
  double floor_m = 0.01;
  double floor_rad = 0.0015;
  /// Standard deviation along the line between the two places, per roughness of the walls and
  /// square of their distance [1/m²]. Of a rough wall seen from two sides each shows the sides of
  /// its bumps that face it, so that the places seem nearer to each other, the more the flatter
  /// both see it. Measured in Mathies (residuals of 0.011 m): 0.006 m at 10 m, 0.09 m at 25 m; as
  /// it is alike at all places, much more than that counts. In Bruceton (0.005 m): nothing.
  double far_view_per_m2 = 0.1;

  template <class V>
  void visit(V& v) {
    v("search", search);
    v("refinement", refinement);
    v("agreement", agreement);
    v("degeneracy", degeneracy);
    v("gate_sigmas", gate_sigmas, within(0.1, 100.0));
    v("radius_max_m", radius_max_m, within(0.1, 50.0));
    v("peaks", peaks, within(1, 100));
    v("points_max", points_max, within(10, 100000));
    v("observed_share_min", observed_share_min, within(0.0, 1.0));
    v("on_wall_share_min", on_wall_share_min, within(0.0, 1.0));
    v("independent_m", independent_m, within(0.01, 1000.0));
    v("log_likelihood_min", log_likelihood_min, at_least(0.0));
    v("correlated_points", correlated_points, within(1.0, 1000.0));
    v("floor_m", floor_m, within(0.0, 1.0));
    v("floor_rad", floor_rad, within(0.0, 1.0));
    v("far_view_per_m2", far_view_per_m2, within(0.0, 100.0));
  }
};

/// A local map placed in the frame of another.
struct PlacedWalls {
  std::shared_ptr<const LocalWalls> walls;
  Pose2 T_older_walls;
  double z_older_walls_m = 0.0;
  /// Of T_older_walls, by the displacement alone: (x, y, θ) in the frame of the walls.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// The predicted pose of a map in the frame of an older one, as a Gaussian.
struct RelativePose {
  Pose2 T_older_newer;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of (x, y, θ) in the newer frame
};

/// Finds the possible poses of the newer map on an older one within the gate of the prediction,
/// most likely first; empty if they do not overlap (paper, section 2.2; Gutmann and Konolige,
/// "Incremental mapping of large cyclic environments", 1999). `older`: the older map and, at fixed
/// poses in its frame, others that help to recognise the place. Directions in which the maps slide
/// along each other carry no information; there the alternative lies at the prediction.
std::vector<LoopClosureAlternative> match_maps(const LocalWalls& newer,
                                               const std::vector<PlacedWalls>& older, int older_id,
                                               const RelativePose& predicted,
                                               const MapMatchingParams& params);

/// The covariance C = I⁻¹ enlarged by A, as an information that stays zero where I is zero:
/// (C + A)⁻¹ = I (1 + A I)⁻¹.
Eigen::Matrix3d with_added_covariance(const Eigen::Matrix3d& information,
                                      const Eigen::Matrix3d& covariance);

/// The evidence against a pose of the newer map, or one close by, even without overlap: −2
/// log-likelihood ratio of the number of walls of each map in the free space of the other, against
/// the number for maps of one place. Chi-square with one or two degrees of freedom if the pose is
/// correct. Evidence up to `relevant` may be that without a search for poses close by, which is
/// most of the time.
double contradiction(const LocalWalls& newer, const std::vector<PlacedWalls>& older,
                     const Pose2& T_older_newer, const MapMatchingParams& params,
                     double relevant = 0.0);

/// Lengths of walls of either map that the other observed [m].
struct WallComparison {
  double observed_m = 0.0;
  double contradicting_m = 0.0;  ///< of these, in free space
  /// By how much the walls of the newer map are before those of the older one, at each point of
  /// either [m].
  std::vector<double> before_m;
};

/// Compares the walls of two maps at a pose, each with what the other observed.
WallComparison compare_walls(const LocalWalls& newer, const std::vector<PlacedWalls>& older,
                             const Pose2& T_older_newer, const MapMatchingParams& params);

/// An upper bound of `contradiction` with the older map alone, without alignment and much cheaper:
/// all points in space that the other map observed free, also where a wall is near.
double contradiction_bound(const LocalWalls& newer, const LocalWalls& older,
                           const Pose2& T_older_newer, const MapMatchingParams& params);

}  // namespace adit
