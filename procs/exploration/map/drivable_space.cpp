// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/map/drivable_space.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "common/grid/grid2.hpp"
#include "procs/exploration/map/known_space.hpp"

namespace adit {
namespace {

/// Distance from the middle of each cell to that of the nearest wall [m], exact in two
/// passes; 0 for what is wall or not seen; at most `largest_m`.
Grid2<float> wall_clearance(const Grid2<Occupancy>& known, double resolution_m, double largest_m);

constexpr int kFar = 1 << 20;  // cells

/// Squares of the distance along each column, by two sweeps.
std::vector<int> along_columns(const Grid2<Occupancy>& known) {
  const auto columns = static_cast<std::size_t>(known.box().size().x());
  std::vector<int> distance(known.size(), kFar);
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i] == Occupancy::kWall) {
      distance[i] = 0;
    } else if (i >= columns) {
      distance[i] = std::min(kFar, distance[i - columns] + 1);
    }
  }
  for (std::size_t i = known.size(); i-- > 0;) {
    if (i + columns < known.size()) distance[i] = std::min(distance[i], distance[i + columns] + 1);
  }
  return distance;
}

Grid2<float> wall_clearance(const Grid2<Occupancy>& known, double resolution_m, double largest_m) {
  Grid2<float> clearance(known.box());
  const std::vector<int> columns_m = along_columns(known);
  const int n = known.box().size().x();
  const int reach = static_cast<int>(std::ceil(largest_m / resolution_m));
  for (std::size_t row = 0; row < known.size(); row += static_cast<std::size_t>(n)) {
    const int* distance = &columns_m[row];
    for (int x = 0; x < n; ++x) {
      const std::size_t i = row + static_cast<std::size_t>(x);
      if (known[i] == Occupancy::kUnseen || known[i] == Occupancy::kWall) continue;
      int best = std::min(distance[x], reach);
      best *= best;
      for (int off = 1; off < reach && off * off < best; ++off) {
        for (const int at : {x - off, x + off}) {
          if (at < 0 || at >= n || distance[at] >= reach) continue;
          best = std::min(best, off * off + distance[at] * distance[at]);
        }
      }
      clearance[i] = static_cast<float>(resolution_m * std::sqrt(static_cast<double>(best)));
    }
  }
  return clearance;
}

constexpr std::uint8_t kBarrier = 1;

/// Along the line to both sides, until what is known to be free ends. In steps of half a cell, two
/// cells thick, so that nothing slips through.
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

void mark_room(DrivableSpace& space) {
  const auto least = static_cast<float>(space.radius_m - 1e-6);
  for (std::size_t i = 0; i < space.known.size(); ++i) {
    const bool room = space.known[i] == Occupancy::kDriven ||
                      (space.known[i] == Occupancy::kFree && space.clearance_m[i] >= least);
    space.access[i] = room ? Access::kUnreachable : Access::kNone;
  }
}

/// From what is marked already, or from a seed, through what is marked as less.
void flood(Grid2<Access>& access, std::vector<std::size_t> open, Access mark,
           const Grid2<std::uint8_t>& barriers, bool stop_at_barriers) {
  const auto around = access.around();
  while (!open.empty()) {
    const std::size_t at = open.back();
    open.pop_back();
    for (const std::ptrdiff_t step : around) {
      const std::size_t next = at + static_cast<std::size_t>(step);
      if (access[next] != Access::kUnreachable || (stop_at_barriers && barriers[next] == kBarrier))
        continue;
      access[next] = mark;
      open.push_back(next);
    }
  }
}

std::vector<std::size_t> all_of(const Grid2<Access>& access, Access which) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < access.size(); ++i) {
    if (access[i] == which) found.push_back(i);
  }
  return found;
}

}  // namespace

DrivableSpace drivable_space(Grid2<Occupancy> known, double resolution_m, double vehicle_width_m,
                             const std::vector<BarrierLine>& barriers,
                             const Eigen::Vector2d& p_map_home, const DrivableParams& params) {
  DrivableSpace space;
  space.resolution_m = resolution_m;
  space.radius_m = vehicle_width_m / 2.0 + params.margin_m;
  space.known = std::move(known);
  space.clearance_m = wall_clearance(space.known, resolution_m, params.clearance_max_m);
  space.access = Grid2<Access>(space.known.box());
  mark_room(space);
  Grid2<std::uint8_t> barrier_cells(space.known.box());
  for (const BarrierLine& barrier : barriers)
    draw(barrier, params.barrier_half_m, space, barrier_cells);
  const Eigen::Vector2i home = space.cell_at(p_map_home);
  if (space.access.get(home) == Access::kNone) return space;
  space.access[space.access.index(home)] = Access::kReachable;
  flood(space.access, {space.access.index(home)}, Access::kReachable, barrier_cells, true);
  flood(space.access, all_of(space.access, Access::kReachable), Access::kBehindBarrier,
        barrier_cells, false);
  return space;
}

}  // namespace adit
