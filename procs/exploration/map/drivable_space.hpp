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

/// A line across a tunnel that a route must not cross: where the planner found no path, confirmed
/// or not, or where the outside of the mine begins. Stored relative to a local map, so that it
/// moves with the map.
struct Barrier {
  enum class Kind : std::uint8_t { kBlocked, kOutsideMine, kUnconfirmed };

  Kind kind = Kind::kBlocked;
  int frontier = -1;  ///< the frontier whose route it closes; -1 for the exit or a route home
  int local_map = 0;
  Eigen::Vector2d p_local{0.0, 0.0};          ///< its middle, in the local map [m]
  Eigen::Vector2d direction_local{1.0, 0.0};  ///< direction of travel that it blocks, a unit vector
  std::string evidence;                       ///< one sentence

  friend bool operator==(const Barrier&, const Barrier&) = default;
};

struct DrivableParams {
  /// To each side of the vehicle. Negative, as cells blur walls: the planner rejects what is too
  /// narrow after all, with evidence.
  double margin_m = -0.05;
  double clearance_max_m = 5.0;  ///< upper limit of the clearance layer
  double barrier_half_m = 8.0;   ///< half-length of a barrier at most

  template <class V>
  void visit(V& v) {
    v("margin_m", margin_m, within(-0.3, 2.0));
    v("clearance_max_m", clearance_max_m, within(1.0, 50.0));
    v("barrier_half_m", barrier_half_m, within(0.5, 100.0));
  }
};

/// Whether a vehicle fits into a cell and can reach it.
enum class Access : std::uint8_t {
  kNone,           ///< wall, unseen, or too close to a wall
  kUnreachable,    ///< the vehicle fits, but no known path there is wide enough
  kBehindBarrier,  ///< every path there crosses a barrier
  kReachable,
};

/// A barrier in map.
struct BarrierLine {
  Eigen::Vector2d p_map{0.0, 0.0};
  Eigen::Vector2d direction_map{1.0, 0.0};
  bool passable_where_driven = false;  ///< driven cells stay passable
};

/// The known space for a circular vehicle of the width of the real one; how it turns is left to the
/// planner. In atlas, as KnownSpace.
struct DrivableSpace {
  double resolution_m = 0.2;
  double radius_m = 0.7;  ///< half the width of the vehicle plus the margin
  Grid2<Occupancy> known;
  Grid2<float> clearance_m;  ///< to the nearest wall [m]; 0 for walls and unseen cells
  Grid2<Access> access;
  /// 1 where the vehicle would be over an obstacle that it cannot drive over, by 3D scans, unless
  /// it has driven there: the planner decides, but it will probably find no path.
  Grid2<std::uint8_t> obstructed;
  SharedCells shared;  ///< of the same box; where the layers are connected

  [[nodiscard]] Eigen::Vector2i cell_at(const Eigen::Vector2d& p_map) const {
    return cell_of(p_map, resolution_m);
  }
  [[nodiscard]] Eigen::Vector2d middle(std::size_t index) const {
    return centre_of(known.cell(index), resolution_m);
  }
};

/// Computes clearance and access of all cells as reached from `p_map_home`. `low_obstacles` is 1
/// where an obstacle is that the level lasers do not see; of the box of `known`, or empty.
DrivableSpace drivable_space(Grid2<Occupancy> known, const Grid2<std::uint8_t>& low_obstacles,
                             double resolution_m, double vehicle_width_m,
                             const std::vector<BarrierLine>& barriers,
                             const Eigen::Vector2d& p_map_home, const DrivableParams& params,
                             SharedCells shared = {});

}  // namespace adit
