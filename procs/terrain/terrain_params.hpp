// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/config/bounds.hpp"
#include "common/types/vehicle.hpp"

namespace adit {

/// From which of the heights in a region its lowest and highest are taken.
struct HeightEstimatorParams {
  /// paper: the least and the greatest of all. kth: the k-th least and greatest, so that fewer than
  /// k stray points change nothing.
  std::string kind = "kth";
  int k = 3;
  /// k is less where points are few: one for each so many of them, at least one.
  int points_per_rank = 10;

  template <class V>
  void visit(V& v) {
    v("kind", kind, OneOf({"paper", "kth"}));
    v("k", k, within(1, 3));
    v("points_per_rank", points_per_rank, at_least(1));
  }
};

/// What is concluded of ground that no point shows.
struct UnseenGroundParams {
  double grade_max = 0.25;      ///< by which ground may rise where it is not seen
  double floor_range_m = 8.0;   ///< up to which any dry floor returns a beam
  double gap_max_m = 1.0;       ///< between beams that met the ground, beyond which it is unknown
  double gap_of_spacing = 2.5;  ///< the same, in distances of the beams on level ground

  template <class V>
  void visit(V& v) {
    v("grade_max", grade_max, at_least(0.0));
    v("floor_range_m", floor_range_m, at_least(0.0));
    v("gap_max_m", gap_max_m, at_least(0.0));
    v("gap_of_spacing", gap_of_spacing, at_least(1.0));
  }
};

/// The kernel that keeps paths away from what is hard to pass.
struct RepulsionParams {
  double radius_m = 0.5;
  double coefficient_min_m = 0.05;  ///< of a cell that repels: noise and pebbles do not

  template <class V>
  void visit(V& v) {
    v("radius_m", radius_m, within(0.0, 2.0));
    v("coefficient_min_m", coefficient_min_m, above(0.0));
  }
};

/// What is taken over from earlier maps, in odom, which drifts.
struct TerrainMemoryParams {
  int maps_max = 8;                 ///< that are kept, of 0.6 MB each; 0: none, and no way either
  double path_length_max_m = 15.0;  ///< since then, beyond which odom is not trusted
  double residual_max_m = 0.06;     ///< of heights that both know, when one plane is taken off
  double inlier_share = 0.75;       ///< of these heights that have to lie within it
  double tilt_max = 0.1;            ///< between two levels, as rise over distance
  double disappeared_share_max =
      0.3;                      ///< of earlier obstacles that are no longer met where they were
  double change_reach_m = 2.0;  ///< round a new obstacle, how far it may reach unseen

  template <class V>
  void visit(V& v) {
    v("maps_max", maps_max, within(0, 50));
    v("path_length_max_m", path_length_max_m, within(0.0, 100.0));
    v("residual_max_m", residual_max_m, above(0.0));
    v("inlier_share", inlier_share, above_up_to(0.0, 1.0));
    v("tilt_max", tilt_max, at_least(0.0));
    v("disappeared_share_max", disappeared_share_max, within(0.0, 1.0));
    v("change_reach_m", change_reach_m, within(0.0, 20.0));
  }
};

struct TerrainParams {
  double cell_m = 0.1;
  double length_m = 20.0;  ///< of the map, along x
  double width_m = 20.0;   ///< along y, half of it to either side
  /// Of the length, how much lies behind the body's origin, seen from the laser that looks.
  double behind_m = 6.0;
  HeightEstimatorParams estimator;
  UnseenGroundParams unseen;
  RepulsionParams repulsion;
  TerrainMemoryParams memory;
  Vehicle vehicle;

  /// Up to which height above the ground things stand in the way [m]. What hangs higher is roof,
  /// and how much room it has to leave is for the planner.
  [[nodiscard]] double headroom_m() const { return vehicle.height_m; }

  template <class V>
  void visit(V& v) {
    v("cell_m", cell_m, within(0.02, 1.0));
    v("length_m", length_m, within(1.0, 100.0));
    v("width_m", width_m, within(1.0, 100.0));
    v("behind_m", behind_m);
    v("estimator", estimator);
    v("unseen", unseen);
    v("repulsion", repulsion);
    v("memory", memory);
    v.shared(Vehicle::kSection, vehicle);
  }
};

}  // namespace adit
