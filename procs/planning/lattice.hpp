// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "procs/planning/c_space.hpp"
#include "procs/planning/close_look.hpp"
#include "procs/planning/motion_primitives.hpp"

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
  std::uint16_t refused =
      CSpace::kUnseen;                    ///< costs from here on; or kLethal: unseen ground is not
  const CloseLook* close_look = nullptr;  ///< without it, what is close is refused
  bool close_is_free = false;             ///< or is not, whatever it meets

  static constexpr std::int32_t kBlocked = -1;

  [[nodiscard]] bool stands(const LatticePose& pose) const {
    return space.contains(pose.column, pose.row) && allows(cost_at(pose));
  }
  [[nodiscard]] static LatticePose behind(const LatticePose& pose, const MotionPrimitive& step) {
    return {pose.column + step.cells.x(), pose.row + step.cells.y(), step.to};
  }
  /// Of a primitive from a pose of the map, or kBlocked.
  [[nodiscard]] std::int32_t cost(const LatticePose& pose, const MotionPrimitive& step) const {
    std::int32_t sum = 0;
    bool close = needs_a_look(cost_at(pose));
    for (const SweptPose& swept : step.swept) {
      const int column = pose.column + swept.column;
      const int row = pose.row + swept.row;
      if (!space.contains(column, row)) return kBlocked;
      const std::uint16_t cost = space.slice(swept.heading)[space.index(column, row)];
      if (!allows(cost)) return kBlocked;
      close = close || needs_a_look(cost);
      sum += CSpace::bare(cost) * swept.way_mm;
    }
    return close && !allows(step.body, step.wheels, pose.column, pose.row) ? kBlocked : sum;
  }
  /// What was not seen is in the way of the body only.
  [[nodiscard]] bool allows(const RunKernel& body, const RunKernel& wheels, int column,
                            int row) const {
    if (close_look == nullptr) return true;
    if (!close_look->is_free(body, wheels, column, row)) return false;
    return refused > CSpace::kUnseen || !close_look->is_unseen(body, column, row);
  }
  [[nodiscard]] static bool needs_a_look(std::uint16_t cost) {
    return CSpace::is_close(cost) || cost == CSpace::kUnseen;
  }

 private:
  [[nodiscard]] std::uint16_t cost_at(const LatticePose& pose) const {
    return space.slice(pose.heading)[space.index(pose.column, pose.row)];
  }
  [[nodiscard]] bool allows(std::uint16_t cost) const {
    return cost < refused && (close_is_free || close_look != nullptr || !CSpace::is_close(cost));
  }
};

}  // namespace adit
