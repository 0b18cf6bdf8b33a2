// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/drivable_space.hpp"

#include <utility>

#include "procs/exploration/clearance.hpp"

namespace adit {
namespace {

constexpr std::uint8_t kCut = 1;

/// Along the line to both sides, until what is known to be free ends. In steps of half a cell, two
/// cells thick, so that nothing slips through.
void draw(const Cut& cut, double half_m, const DrivableSpace& space,
          CellField<std::uint8_t>& cuts) {
  const Eigen::Vector2d across(-cut.direction_map.y(), cut.direction_map.x());
  const double step = space.resolution_m / 2.0;
  for (const double side : {-1.0, 1.0}) {
    for (double way = 0.0; way <= half_m; way += step) {
      const Eigen::Vector2d p = cut.p_map + side * way * across;
      const Known known = space.known.get(space.cell_at(p), Known::kUnseen);
      if (known == Known::kUnseen || known == Known::kWall) break;
      for (const double along : {0.0, step, 2.0 * step}) {
        const Eigen::Vector2i cell = space.cell_at(p + along * cut.direction_map);
        if (!cuts.box().contains(cell)) continue;
        const std::size_t i = cuts.index(cell);
        if (!cut.spares_driven || space.known[i] != Known::kDriven) cuts[i] = kCut;
      }
    }
  }
}

void mark_room(DrivableSpace& space) {
  const auto least = static_cast<float>(space.radius_m - 1e-6);
  for (std::size_t i = 0; i < space.known.size(); ++i) {
    const bool room = space.known[i] == Known::kDriven ||
                      (space.known[i] == Known::kFree && space.clearance_m[i] >= least);
    space.access[i] = room ? Access::kNoWay : Access::kNone;
  }
}

/// From what is marked already, or from a seed, through what is marked as less.
void flood(CellField<Access>& access, std::vector<std::size_t> open, Access mark,
           const CellField<std::uint8_t>& cuts, bool stop_at_cuts) {
  const auto around = access.around();
  while (!open.empty()) {
    const std::size_t at = open.back();
    open.pop_back();
    for (const std::ptrdiff_t step : around) {
      const std::size_t next = at + static_cast<std::size_t>(step);
      if (access[next] != Access::kNoWay || (stop_at_cuts && cuts[next] == kCut)) continue;
      access[next] = mark;
      open.push_back(next);
    }
  }
}

std::vector<std::size_t> all_of(const CellField<Access>& access, Access which) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < access.size(); ++i) {
    if (access[i] == which) found.push_back(i);
  }
  return found;
}

}  // namespace

DrivableSpace drivable_space(CellField<Known> known, double resolution_m, double vehicle_width_m,
                             const std::vector<Cut>& cuts, const Eigen::Vector2d& p_map_home,
                             const DrivableParams& params) {
  DrivableSpace space;
  space.resolution_m = resolution_m;
  space.radius_m = vehicle_width_m / 2.0 + params.margin_m;
  space.known = std::move(known);
  space.clearance_m = wall_clearance(space.known, resolution_m, params.clearance_max_m);
  space.access = CellField<Access>(space.known.box());
  mark_room(space);
  CellField<std::uint8_t> cut_cells(space.known.box());
  for (const Cut& cut : cuts) draw(cut, params.barrier_half_m, space, cut_cells);
  const Eigen::Vector2i home = space.cell_at(p_map_home);
  if (space.access.get(home) == Access::kNone) return space;
  space.access[space.access.index(home)] = Access::kReachable;
  flood(space.access, {space.access.index(home)}, Access::kReachable, cut_cells, true);
  flood(space.access, all_of(space.access, Access::kReachable), Access::kBehindBarrier, cut_cells,
        false);
  return space;
}

}  // namespace adit
