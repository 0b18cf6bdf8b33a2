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

/// Length by cost that driving 1 m of even ground takes: the unit of all costs of a search.
inline constexpr std::int32_t kCostPerM = 1000 * CSpace::kEven;

/// A pose of the lattice.
struct LatticePose {
  int column = 0;
  int row = 0;
  int heading = 0;

  friend bool operator==(const LatticePose&, const LatticePose&) = default;
};

/// What can be driven in a C-space.
struct Lattice {
  const CSpace& space;
  const MotionPrimitives& primitives;
  std::uint16_t cost_limit =
      CSpace::kUnknown;  ///< costs from here on; or kLethal: unseen ground is not
  const ExactCheck* exact_check = nullptr;  ///< without it, what is close is refused
  bool marginal_is_free = false;            ///< or is not, whatever it meets

  static constexpr std::int32_t kBlocked = -1;

  [[nodiscard]] bool is_valid(const LatticePose& pose) const {
    return space.contains(pose.column, pose.row) && allows(cost_at(pose));
  }
  [[nodiscard]] static LatticePose successor(const LatticePose& pose, const MotionPrimitive& step) {
    return {pose.column + step.cells.x(), pose.row + step.cells.y(), step.to};
  }
  /// Of a primitive from a pose of the map, or kBlocked.
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
  /// What was not seen is in the way of the body only.
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
    return space.slice(pose.heading)[space.index(pose.column, pose.row)];
  }
  [[nodiscard]] bool allows(std::uint16_t cost) const {
    return cost < cost_limit &&
           (marginal_is_free || exact_check != nullptr || !CSpace::is_marginal(cost));
  }
};

/// The pose of the lattice nearest to one in level; outside of the map if that is.
LatticePose nearest_pose(const TerrainMap& terrain, const HeadingSet& headings,
                         const Pose2& T_level_body);

/// A robot beside an obstacle may stand where the conservative kernels forbid it: around the start,
/// poses are allowed that only their margin makes lethal, at the cost of ground at the limit, so
/// that the robot can leave. The rectangles of the vehicle itself stay clear of what is lethal, but
/// for half a cell: the pose of the lattice is that far from the robot, and regions of the terrain
/// make things wider by a whole one.
void clear_start(CSpace& space, const LatticePose& start, const GroundLayers& layers,
                 const CSpaceKernels& kernels, std::uint16_t cost);

}  // namespace adit
