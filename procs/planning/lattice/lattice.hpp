// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "common/types/terrain_map.hpp"
#include "common/types/vehicle.hpp"
#include "procs/planning/c_space/c_space.hpp"
#include "procs/planning/lattice/motion_primitives.hpp"

namespace adit {

/// A pose of the lattice: a cell, with the body at its centre, and a heading of the HeadingSet.
struct LatticePose {
  int column = 0;
  int row = 0;
  int heading = 0;

  friend bool operator==(const LatticePose&, const LatticePose&) = default;
};

/// The state lattice: motion primitives in a C-space, and the collision check.
struct Lattice {
  const CSpace& space;
  const MotionPrimitives& primitives;
  /// Poses from this cost on are blocked: kUnknown, or kLethal to drive over unobserved ground.
  std::uint16_t cost_limit = CSpace::kUnknown;
  const ExactCheck* exact_check = nullptr;  ///< for marginal poses; without it they are blocked
  bool marginal_is_free = false;            ///< all marginal poses are free, without a check

  static constexpr std::int32_t kBlocked = -1;  ///< cost of a primitive that collides

  [[nodiscard]] bool is_valid(const LatticePose& pose) const {
    return space.contains(pose.column, pose.row) && allows(cost_at(pose));
  }
  [[nodiscard]] static LatticePose successor(const LatticePose& pose, const MotionPrimitive& step) {
    return {pose.column + step.cells.x(), pose.row + step.cells.y(), step.to};
  }
  /// Cost of a primitive from a pose of the map (path_cost.hpp), or kBlocked.
  [[nodiscard]] std::int32_t cost(const LatticePose& pose, const MotionPrimitive& step) const {
    std::int32_t sum = 0;
    bool marginal = needs_exact_check(cost_at(pose));
    for (const SweptPose& swept : step.swept) {
      const int column = pose.column + swept.column;
      const int row = pose.row + swept.row;
      if (!space.contains(column, row)) return kBlocked;
      const std::uint16_t cost = space.slice(swept.heading)[space.index(column, row)];
      if (!allows(cost)) return kBlocked;
      marginal = marginal || needs_exact_check(cost);
      sum += CSpace::unmarked(cost) * swept.length_mm;
    }
    return marginal && !allows(step.body, step.wheels, pose.column, pose.row) ? kBlocked : sum;
  }
  /// Whether the exact check allows the kernels. Unobserved ground blocks the body only.
  [[nodiscard]] bool allows(const RunKernel& body, const RunKernel& wheels, int column,
                            int row) const {
    if (exact_check == nullptr) return true;
    if (!exact_check->is_free(body, wheels, column, row)) return false;
    return cost_limit > CSpace::kUnknown || !exact_check->is_unknown(body, column, row);
  }
  [[nodiscard]] static bool needs_exact_check(std::uint16_t cost) {
    return CSpace::is_marginal(cost) || cost == CSpace::kUnknown;
  }

 private:
  [[nodiscard]] std::uint16_t cost_at(const LatticePose& pose) const {
    return space.slice(pose.heading).at({pose.column, pose.row});
  }
  [[nodiscard]] bool allows(std::uint16_t cost) const {
    return cost < cost_limit &&
           (marginal_is_free || exact_check != nullptr || !CSpace::is_marginal(cost));
  }
};

/// The pose of the lattice nearest to a pose in level; outside the map if that pose is.
LatticePose nearest_pose(const TerrainMap& terrain, const HeadingSet& headings,
                         const Pose2& T_level_body);

/// Lets a robot leave a start beside an obstacle that the conservative kernels reject: poses within
/// 0.6 m of the start that are lethal or marginal by their margin only get `cost`. The footprint
/// shrunk by half a cell must not overlap lethal ground: the pose of the lattice is up to half a
/// cell from the robot, and obstacles in the terrain map are up to a cell too wide.
void clear_start(CSpace& space, const LatticePose& start, const GroundLayers& layers,
                 const CSpaceKernels& kernels, std::uint16_t cost);

}  // namespace adit
