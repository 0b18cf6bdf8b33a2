// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/map/drivable_space.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "common/grid/distance_transform.hpp"
#include "common/grid/grid2.hpp"
#include "procs/exploration/map/known_space.hpp"

namespace adit {
namespace {

/// Distance from the centre of each cell to that of the nearest wall [m], at most `clearance_max_m`
/// rounded up to full cells; 0 for walls and unseen cells.
Grid2<float> wall_clearance(const Grid2<Occupancy>& known, double resolution_m,
                            double clearance_max_m) {
  Grid2<std::uint8_t> walls(known.box());
  for (std::size_t i = 0; i < known.size(); ++i) walls[i] = known[i] == Occupancy::kWall ? 1 : 0;
  const Grid2<float> distance_m = distance_transform(walls, resolution_m);
  const auto limit_m = static_cast<float>(resolution_m * std::ceil(clearance_max_m / resolution_m));
  Grid2<float> clearance(known.box());
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i] != Occupancy::kUnseen) clearance[i] = std::min(distance_m[i], limit_m);
  }
  return clearance;
}

constexpr std::uint8_t kBarrier = 1;

/// Marks the cells of a barrier to both sides of its middle, as far as the known free space
/// reaches. Steps of half a cell and two cells of thickness leave no gap.
void draw(const BarrierLine& barrier, double half_m, const DrivableSpace& space,
          Grid2<std::uint8_t>& barriers) {
  const Eigen::Vector2d across(-barrier.direction_map.y(), barrier.direction_map.x());
  const double step = space.resolution_m / 2.0;
  for (const double side : {-1.0, 1.0}) {
    for (double distance = 0.0; distance <= half_m; distance += step) {
      const Eigen::Vector2d p = barrier.p_map + side * distance * across;
      const Occupancy known = space.known.get(space.cell_at(p), Occupancy::kUnseen);
      if (known == Occupancy::kUnseen || known == Occupancy::kWall) break;
      for (const double along : {0.0, step, 2.0 * step}) {
        const Eigen::Vector2i cell = space.cell_at(p + along * barrier.direction_map);
        if (!barriers.box().contains(cell)) continue;
        const std::size_t i = barriers.index(cell);
        if (!barrier.passable_where_driven || space.known[i] != Occupancy::kDriven)
          barriers[i] = kBarrier;
      }
    }
  }
}

/// Marks the cells into which the vehicle fits as kUnreachable, all others as kNone.
void mark_cells_that_fit(DrivableSpace& space) {
  const auto least = static_cast<float>(space.radius_m - 1e-6);
  for (std::size_t i = 0; i < space.known.size(); ++i) {
    const bool fits = space.known[i] == Occupancy::kDriven ||
                      (space.known[i] == Occupancy::kFree && space.clearance_m[i] >= least);
    space.access[i] = fits ? Access::kUnreachable : Access::kNone;
  }
}

/// The cells within the radius of the vehicle of an obstacle.
Grid2<std::uint8_t> obstructed_cells(const DrivableSpace& space,
                                     const Grid2<std::uint8_t>& low_obstacles) {
  Grid2<std::uint8_t> obstructed(space.known.box());
  if (low_obstacles.size() == 0) return obstructed;
  const Grid2<float> distance_m = distance_transform(low_obstacles, space.resolution_m);
  const auto radius_m = static_cast<float>(space.radius_m);
  for (std::size_t i = 0; i < obstructed.size(); ++i)
    obstructed[i] = space.known[i] != Occupancy::kDriven && distance_m[i] < radius_m ? 1 : 0;
  return obstructed;
}

/// Flood fill from `open` through cells that are kUnreachable, which become `mark`.
void flood(DrivableSpace& space, std::vector<std::size_t> open, Access mark,
           const Grid2<std::uint8_t>& barriers, bool stop_at_barriers) {
  Grid2<Access>& access = space.access;
  const auto around = access.around();
  const auto enter = [&](std::size_t next) {
    if (access[next] != Access::kUnreachable || (stop_at_barriers && barriers[next] == kBarrier))
      return;
    access[next] = mark;
    open.push_back(next);
  };
  while (!open.empty()) {
    const std::size_t at = open.back();
    open.pop_back();
    for (const std::ptrdiff_t step : around) enter(at + static_cast<std::size_t>(step));
    space.shared.for_each(at, [&](std::size_t next, int) { enter(next); });
  }
}

std::vector<std::size_t> cells_with(const Grid2<Access>& access, Access value) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < access.size(); ++i) {
    if (access[i] == value) found.push_back(i);
  }
  return found;
}

}  // namespace

DrivableSpace drivable_space(Grid2<Occupancy> known, const Grid2<std::uint8_t>& low_obstacles,
                             double resolution_m, double vehicle_width_m,
                             const std::vector<BarrierLine>& barriers,
                             const Eigen::Vector2d& p_map_home, const DrivableParams& params,
                             SharedCells shared) {
  DrivableSpace space;
  space.shared = std::move(shared);
  space.resolution_m = resolution_m;
  space.radius_m = vehicle_width_m / 2.0 + params.margin_m;
  space.known = std::move(known);
  space.clearance_m = wall_clearance(space.known, resolution_m, params.clearance_max_m);
  space.access = Grid2<Access>(space.known.box());
  mark_cells_that_fit(space);
  space.obstructed = obstructed_cells(space, low_obstacles);
  Grid2<std::uint8_t> barrier_cells(space.known.box());
  for (const BarrierLine& barrier : barriers)
    draw(barrier, params.barrier_half_m, space, barrier_cells);
  const Eigen::Vector2i home = space.cell_at(p_map_home);
  if (space.access.get(home) == Access::kNone) return space;
  space.access[space.access.index(home)] = Access::kReachable;
  flood(space, {space.access.index(home)}, Access::kReachable, barrier_cells, true);
  flood(space, cells_with(space.access, Access::kReachable), Access::kBehindBarrier, barrier_cells,
        false);
  return space;
}

}  // namespace adit
