// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/config/bounds.hpp"
#include "common/types/vehicle.hpp"

namespace adit {

/// Estimator of the lowest and highest height of a region.
struct HeightEstimatorParams {
  /// paper: least and greatest height. kth: k-th least and greatest, so that fewer than k stray
  /// points have no effect.
  std::string kind = "kth";
  int k = 3;
  /// One rank per this many points, at least one and at most k.
  int points_per_rank = 10;

  template <class V>
  void visit(V& v) {
    v("kind", kind, OneOf({"paper", "kth"}));
    v("k", k, within(1, 3));
    v("points_per_rank", points_per_rank, at_least(1));
  }
};

/// Classification of ground without points.
struct UnseenGroundParams {
  double grade_max = 0.25;      ///< maximal grade of unobserved ground, beyond its trend
  double floor_range_m = 8.0;   ///< range up to which dry ground returns a beam
  double gap_max_m = 1.0;       ///< larger gaps between beams that hit the ground are unknown
  double gap_of_spacing = 2.5;  ///< the same, in spacings of the beams on level ground

  template <class V>
  void visit(V& v) {
    v("grade_max", grade_max, at_least(0.0));
    v("floor_range_m", floor_range_m, at_least(0.0));
    v("gap_max_m", gap_max_m, at_least(0.0));
    v("gap_of_spacing", gap_of_spacing, at_least(1.0));
  }
};

/// Kernel that keeps paths away from cells that are hard to pass.
struct RepulsionParams {
  double radius_m = 0.5;
  double coefficient_min_m = 0.05;  ///< cells below it do not repel: noise and pebbles

  template <class V>
  void visit(V& v) {
    v("radius_m", radius_m, within(0.0, 2.0));
    v("coefficient_min_m", coefficient_min_m, above(0.0));
  }
};

/// Memory of earlier maps, in odom and placed by map.
struct TerrainMemoryParams {
  /// Stored maps, 0.2 MB each in a tunnel; 0: no memory and no path.
  int maps_max = 500;
  double distance_max_m = 40.0;        ///< driven since a scan or since map placed it
  double path_length_max_m = 15.0;     ///< shortest path to a scan; beyond may be another level
  double residual_max_m = 0.06;        ///< residual of the height differences to a plane
  double inlier_share = 0.75;          ///< share of the differences that must lie within it
  double tilt_max = 0.1;               ///< relative tilt of two levels, as rise over distance
  double disappeared_share_max = 0.3;  ///< share of earlier obstacles that have disappeared
  double change_reach_m = 2.0;         ///< unobserved extent of a new obstacle

  template <class V>
  void visit(V& v) {
    v("maps_max", maps_max, within(0, 1000));
    v("distance_max_m", distance_max_m, within(0.0, 1000.0));
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
  double length_m = 20.0;  ///< length of the map along x
  double width_m = 20.0;   ///< width along y, half of it to each side
  /// Part of the length behind the origin of body, opposite to the scanning laser.
  double behind_m = 6.0;
  HeightEstimatorParams estimator;
  UnseenGroundParams unseen;
  RepulsionParams repulsion;
  TerrainMemoryParams memory;
  Vehicle vehicle;

  /// Height above the ground up to which obstacles block the vehicle [m]. Anything higher is roof,
  /// whose clearance the planner checks.
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
