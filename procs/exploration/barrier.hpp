// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include <Eigen/Core>

namespace adit {

/// A line across a drift that is not to be crossed: where the planner found no way, by what was
/// seen or not for certain, or where the outside begins. Tied to a local map, so that it moves with
/// the map.
struct Barrier {
  enum class Kind : std::uint8_t { kBlocked, kWayOut, kDoubtful };

  Kind kind = Kind::kBlocked;
  int stub = -1;  ///< whose way it cuts off; -1 for the way out
  int local_map = 0;
  Eigen::Vector2d p_local{0.0, 0.0};          ///< its middle
  Eigen::Vector2d direction_local{1.0, 0.0};  ///< in which it cannot be crossed, a unit vector
  std::string evidence;                       ///< a sentence

  friend bool operator==(const Barrier&, const Barrier&) = default;
};

}  // namespace adit
