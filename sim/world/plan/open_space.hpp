// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sim/world/plan/plan_shapes.hpp"
#include "sim/world/plan/tunnel_line.hpp"
#include "sim/world/relief.hpp"
#include "sim/world/world_description.hpp"

namespace adit {

/// Where rock is not: the plan of a mine as a function, drifts and rooms without the pillars. In
/// front of an entrance there is an apron of ground under the open sky. Frame world.
class OpenSpace {
 public:
  /// Of the ground in front of an entrance.
  static constexpr double kApronLength = 4.0;

  /// Throws std::invalid_argument for a plan without drift or room, or that reaches farther than
  /// kExtentMax, and for odd lists of points.
  OpenSpace(const WorldDescription& description, const std::vector<TunnelLine>& tunnels);
  static constexpr double kExtentMax = 5000.0;  ///< from the origin along each axis [m]

  /// How far a place is from the walls as planned; negative in rock. Exact at and around a wall,
  /// no more than that where shapes overlap. Beyond the reach of all walls in rock, that reach.
  [[nodiscard]] double planned_depth_m(const Eigen::Vector2d& p_world) const;
  /// The same for walls that are rough in plan: zero on the line where they meet the floor.
  [[nodiscard]] double depth_m(const Eigen::Vector2d& p_world) const;
  /// By how much the wall stands back at a place of it, beyond what `depth_m` says.
  [[nodiscard]] double bulge_m(const Eigen::Vector3d& p_world) const {
    return relief_in_height_.in_space(p_world);
  }
  /// Whether a place is in front of an entrance.
  [[nodiscard]] bool on_apron(const Eigen::Vector2d& p_world) const;

  /// Squares of a whole number of grid edges.
  [[nodiscard]] const PlanBuckets& buckets() const { return buckets_; }

 private:
  struct Shapes {
    std::vector<PlanShape> all;         ///< what is open, then the pillars
    std::size_t open = 0;               ///< how many are open
    std::vector<TunnelSegment> aprons;  ///< along x outwards
  };
  static Shapes shapes_of(const PlanDescription& plan, const std::vector<TunnelLine>& tunnels);
  static PlanBuckets buckets_of(const Shapes& shapes, double grid_m, double reach_m);

  Shapes shapes_;
  double reach_m_;
  PlanBuckets buckets_;
  Relief relief_in_plan_;
  Relief relief_in_height_;
};

}  // namespace adit
