// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace adit {

/// The cost of a path, which A* minimises (section 3.3 of the paper). All terms are integers in one
/// unit: driving 1 mm over even ground costs kEvenCost, 1 m costs kCostPerM. The terms are
///
/// | term                | value                                            | added in |
/// |---------------------|--------------------------------------------------|-------------------------|
/// | pose                | kEvenCost · (1 + rough_factor · weighted mean    | c_space/c_space.cpp:
/// | |  [per mm driven]    | roughness under the vehicle)                     | CSpaceKernels | |
/// - roughness [0, 1] | step as a share of its limit, or half that of    | c_space/ground_layers |
/// |                     | the slope; unknown_roughness for unobserved      | | | | ground, 0 under
/// the robot and in its blind zone; |                         | |                     | + repulsion
/// of obstacles around; 1 at most       |                         | | travel              | Σ pose
/// cost · length [mm] over the poses that a  | lattice/lattice.hpp     | |                     |
/// primitive sweeps                                 |                         | |  - bends | length
/// · turn_factor                             | lattice/                | |                     | |
/// motion_primitives.cpp   | |  - reverse          | length · reverse_factor; forwards instead for
/// | lattice/                | |                     | goals behind the robot |
/// lattice_symmetry.cpp    | | direction change    | direction_change_m · kCostPerM for each change
/// | lattice/                | |                     | between forwards and reverse |
/// lattice_search.cpp      | | start pose          | if only margins make it lethal: cost of ground
/// | lattice/lattice.cpp     | |                     | at the limit, for the poses around it | | |
/// end of the path     | along a line or route: shortfall_factor · metres | goals/goal_field.cpp |
/// |  [once]             | short of the goal + lateral_factor · metres      | | | | beside the
/// line; within the goal radius:         |                         | |                     |
/// shortfall_factor · metres from the goal; at a    |                         | | | goal pose:
/// metres from it; rejoining: metres of  |                         | |                     |
/// traversed path that remain                       |                         | | | +
/// end_clearance_factor · metres of clearance     |                         | | | below
/// end_clearance_m, outside the goal radius   |                         | |                     |
/// where a line or route continues                  |                         |
///
/// Planning chooses among them: the cost of the start pose and the direction of reverse in
/// planning.cpp.
inline constexpr std::uint16_t kEvenCost = 100;
inline constexpr std::int32_t kCostPerM = 1000 * kEvenCost;

/// Cost of so many metres of even ground.
inline std::int32_t even_ground_cost(double distance_m) {
  return static_cast<std::int32_t>(std::lround(kCostPerM * distance_m));
}

inline constexpr std::int32_t kUnreachable = std::numeric_limits<std::int32_t>::max();

/// The goals of a search, as A* and its heuristic see them: the array of goals of section 3.3 of
/// the paper. GoalField implements it.
class GoalArray {
 public:
  static constexpr std::int32_t kNoGoal = -1;

  virtual ~GoalArray() = default;

  /// Cost of ending in a cell, or kNoGoal.
  [[nodiscard]] virtual std::int32_t ending_cost(std::size_t cell) const = 0;
  /// Whether a path may end in a cell with this heading [rad].
  [[nodiscard]] virtual bool accepts(std::size_t cell, double heading_rad) const = 0;

 protected:
  GoalArray() = default;
  GoalArray(const GoalArray&) = default;
  GoalArray(GoalArray&&) = default;
  GoalArray& operator=(const GoalArray&) = default;
  GoalArray& operator=(GoalArray&&) = default;
};

}  // namespace adit
