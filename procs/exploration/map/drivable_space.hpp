// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/grid/grid2.hpp"
#include "procs/exploration/map/known_space.hpp"

namespace adit {

/// A line across a drift that is not to be crossed: where the planner found no way, by what was
/// seen or not for certain, or where the outside begins. Tied to a local map, so that it moves with
/// the map.
struct Barrier {
  enum class Kind : std::uint8_t { kBlocked, kOutsideMine, kUnconfirmed };

  Kind kind = Kind::kBlocked;
  int frontier = -1;  ///< whose way it cuts off; -1 for the way out
  int local_map = 0;
  Eigen::Vector2d p_local{0.0, 0.0};          ///< its middle
  Eigen::Vector2d direction_local{1.0, 0.0};  ///< in which it cannot be crossed, a unit vector
  std::string evidence;                       ///< a sentence

  friend bool operator==(const Barrier&, const Barrier&) = default;
};

struct DrivableParams {
  /// Beside the vehicle: less than nothing, as cells blur walls. What is too narrow after all, the
  /// planner refuses, with evidence.
  double margin_m = -0.05;
  double clearance_max_m = 5.0;  ///< farther walls count as that far
  double barrier_half_m = 8.0;   ///< at most, to each side

  template <class V>
  void visit(V& v) {
    v("margin_m", margin_m, within(-0.3, 2.0));
    v("clearance_max_m", clearance_max_m, within(1.0, 50.0));
    v("barrier_half_m", barrier_half_m, within(0.5, 100.0));
  }
};

/// Whether a vehicle can be in a cell, and come there.
enum class Access : std::uint8_t {
  kNone,           ///< wall, not seen, or too near to a wall
  kUnreachable,    ///< there would be room, but no known way there is wide enough
  kBehindBarrier,  ///< the way there leads through a barrier
  kReachable,
};

/// A line that cuts a drift, in map.
struct BarrierLine {
  Eigen::Vector2d p_map{0.0, 0.0};
  Eigen::Vector2d direction_map{1.0, 0.0};
  bool passable_where_driven = false;  ///< where the body has been, it does not cut
};

/// The known space for a vehicle that is as long as it is wide: how it turns is for the planner.
struct DrivableSpace {
  double resolution_m = 0.2;
  double radius_m = 0.7;  ///< half the width of the vehicle and the margin
  Grid2<Occupancy> known;
  Grid2<float> clearance_m;  ///< to the nearest wall
  Grid2<Access> access;

  [[nodiscard]] Eigen::Vector2i cell_at(const Eigen::Vector2d& p_map) const {
    return cell_of(p_map, resolution_m);
  }
  [[nodiscard]] Eigen::Vector2d middle(std::size_t index) const {
    return centre_of(known.cell(index), resolution_m);
  }
};

/// Of what can be reached from `p_map_home`.
DrivableSpace drivable_space(Grid2<Occupancy> known, double resolution_m, double vehicle_width_m,
                             const std::vector<BarrierLine>& barriers,
                             const Eigen::Vector2d& p_map_home, const DrivableParams& params);

}  // namespace adit
