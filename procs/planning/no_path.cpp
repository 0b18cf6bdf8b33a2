// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/no_path.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "common/types/body_outline.hpp"
#include "procs/planning/blocking_evidence.hpp"
#include "procs/planning/c_space/unobserved_ground.hpp"

namespace adit {
namespace {

// Progress beyond an obstacle that counts as passing it. A smaller robot gets closer to a wall, but
// not through it.
constexpr double kPassedM = 1.0;

/// The reason of most cells. At the edge of water some beams pass low over it to the roof or a wall
/// behind, as over a drop: with a share of cells without any return these count as water, too.
std::string main_reason(const std::vector<BlockingCell>& cells) {
  constexpr int kDropsPerWater = 4;
  if (cells.empty()) return "the edge of the map";
  std::map<BlockingCell::Reason, int> counts;
  for (const BlockingCell& cell : cells) ++counts[cell.reason];
  if (counts[BlockingCell::Reason::kDrop] <= kDropsPerWater * counts[BlockingCell::Reason::kWater])
    counts[BlockingCell::Reason::kWater] += std::exchange(counts[BlockingCell::Reason::kDrop], 0);
  const auto main =
      std::ranges::max_element(counts, {}, [](const auto& reason) -> int { return reason.second; });
  return description_of(main->first);
}

/// The cells in the lane of the vehicle ahead of its farthest pose, which decide that it ends
/// there; all cells if there are none. The front of the region also touches the walls beside it,
/// which often have more cells than what lies across the tunnel.
std::vector<BlockingCell> cells_in_lane(const std::vector<BlockingCell>& cells,
                                        const ReachableRegion& region, const GoalField& goals,
                                        const CSpace& space, const NoPathContext& context) {
  const auto progress = [&](const LatticePose& pose) {
    return goals.progress(space.index(pose.column, pose.row));
  };
  const auto farthest = std::max_element(
      region.poses.begin(), region.poses.end(),
      [&](const LatticePose& a, const LatticePose& b) { return progress(a) < progress(b); });
  const Eigen::Vector2d p_level = context.terrain.centre(farthest->column, farthest->row);
  const Eigen::Vector2d ahead = goals.direction(p_level);
  const Pose2 T_level_odom = context.terrain.T_odom_level.inverse();
  std::vector<BlockingCell> found;
  for (const BlockingCell& cell : cells) {
    const Eigen::Vector2d offset = T_level_odom * cell.p_odom - p_level;
    const double lateral_m = ahead.x() * offset.y() - ahead.y() * offset.x();
    if (std::abs(lateral_m) <= 0.5 * context.vehicle.width_m) found.push_back(cell);
  }
  return found.empty() ? cells : found;
}

std::vector<std::uint8_t> cells_of(const ReachableRegion& region, const CSpace& space) {
  std::vector<std::uint8_t> reached(space.cells(), 0);
  for (const LatticePose& pose : region.poses) reached[space.index(pose.column, pose.row)] = 1;
  return reached;
}

PlannedPath explain_blocked_start(const LatticePose& start, const Lattice& lattice,
                                  const EvidenceContext& context) {
  PlannedPath path;
  path.outcome = PlanOutcome::kStartBlocked;
  if (!lattice.space.contains(start.column, start.row)) {
    path.reason = "The robot is not on the terrain map.";
    return path;
  }
  path.blocking = blocking_cells(start, lattice, context);
  path.reason = fmt::format("The start pose is blocked by {}.", main_reason(path.blocking));
  return path;
}

/// Where unobserved ground may hide a path: ahead of the robot and along its route. A path that
/// returns, leaves the scanned area and leads around through the rock does not exist.
class Ahead {
 public:
  Ahead(const NoPathContext& context, const GoalField& goals)
      : terrain_(context.terrain),
        goals_(goals),
        p_level_body_(context.T_level_body.translation()),
        direction_(goals.direction(p_level_body_)) {}

  [[nodiscard]] bool contains(int column, int row) const {
    if (goals_.progress(terrain_.cells.index({column, row})) > 0.0) return true;
    return direction_.dot(terrain_.centre(column, row) - p_level_body_) >= 0.0;
  }

 private:
  const TerrainMap& terrain_;
  const GoalField& goals_;
  Eigen::Vector2d p_level_body_;
  Eigen::Vector2d direction_;
};

/// The terrain map with nothing above the ground ahead whose headroom is hidden. To planning it is
/// as lethal as an obstacle, and it surrounds what a scan shows in a branch.
TerrainMap with_open_headroom(TerrainMap terrain, const Ahead& ahead) {
  for (std::size_t i = 0; i < terrain.cells.size(); ++i) {
    TerrainCell& cell = terrain.cells[i];
    const Eigen::Vector2i at = terrain.cells.cell(i);
    const bool is_hidden = cell.ground == Ground::kObserved && std::isnan(cell.clearance_m);
    if (is_hidden && ahead.contains(at.x(), at.y()))
      cell.clearance_m = std::numeric_limits<float>::infinity();
  }
  return terrain;
}

/// The C-space in which unobserved ground is lethal unless it is ahead.
CSpace with_unknown_ahead_only(CSpace space, const Ahead& ahead) {
  for (int row = 0; row < space.rows(); ++row) {
    for (int column = 0; column < space.columns(); ++column) {
      if (ahead.contains(column, row)) continue;
      for (int heading = 0; heading < space.headings() / 2; ++heading) {
        std::uint16_t& cost = space.slice(heading).at({column, row});
        if (cost == CSpace::kUnknown) cost = CSpace::kLethal;
      }
    }
  }
  return space;
}

GroundLimits without_margins(GroundLimits limits) {
  limits.step_margin_m = limits.belly_margin_m = limits.roof_margin_m = 0.0;
  return limits;
}

/// Obstacles of the terrain map extend up to a cell beyond the true ones, which narrows a gap on
/// either side; a vehicle that is smaller by as much compensates for it.
Vehicle without_cell_margin(Vehicle vehicle, double cell_m) {
  vehicle = with_outline_grown(std::move(vehicle), -cell_m);
  vehicle.track_m -= 2.0 * cell_m;
  return vehicle;
}

/// The progress that the robot may make if unobserved ground ahead is free, at least `enough_m` if
/// it is more. Of this and the next function `context` has the terrain with open headroom.
double progress_over_unknown_m(const Lattice& lattice, const LatticePose& start,
                               const GoalField& goals, const NoPathContext& context,
                               double enough_m) {
  const GroundLayers layers =
      ground_layers(context.terrain, context.T_level_body, context.vehicle, context.c_space.ground);
  const ExactCheck exact_check(layers, lattice.primitives.reach());
  CSpace space = context.kernels.convolve(layers);
  space.keep_lower(lattice.space);  // in which the start may have been cleared
  space = with_unknown_ahead_only(std::move(space), Ahead(context, goals));
  const Lattice over_unknown{space, lattice.primitives, CSpace::kLethal, &exact_check};
  return reachable_region(over_unknown, start, goals, enough_m).progress_m;
}

/// Whether the robot may make a progress of `enough_m` if all margins are removed: the safety
/// margins, those of the cells of obstacles and poses (as much again, a cell on each side of a gap
/// for each), and unconfirmed drops. If so, the obstacle does not prove that there is no path.
bool fits_without_margins(const Lattice& lattice, const LatticePose& start, const GoalField& goals,
                          const NoPathContext& context, double enough_m) {
  const TerrainMap terrain = with_confirmed_drops(context.terrain, context.vehicle.step_max_m,
                                                  std::tan(context.c_space.ground.slope_max_rad));
  const CSpaceKernels kernels(without_cell_margin(context.vehicle, terrain.cell_m), context.c_space,
                              terrain.cell_m);
  const GroundLayers layers = ground_layers(terrain, context.T_level_body, context.vehicle,
                                            without_margins(context.c_space.ground));
  const CSpace space = with_unknown_ahead_only(kernels.convolve(layers), Ahead(context, goals));
  const Lattice permissive{space, lattice.primitives, CSpace::kLethal, nullptr, true};
  return reachable_region(permissive, start, goals, enough_m).progress_m >= enough_m;
}

}  // namespace

NoPathExplanation explain_no_path(const Lattice& lattice, const LatticePose& start,
                                  const GoalField& goals, const NoPathContext& context) {
  const EvidenceContext evidence{context.terrain, context.layers, context.kernels, context.vehicle,
                                 context.c_space.ground};
  if (!lattice.is_valid(start)) return {explain_blocked_start(start, lattice, evidence), {}};

  const ReachableRegion region = reachable_region(lattice, start, goals);
  const double min_progress_m = goals.min_progress();
  const TerrainMap open_terrain = with_open_headroom(context.terrain, Ahead(context, goals));
  const NoPathContext if_open{open_terrain,    context.T_level_body, context.layers,
                              context.kernels, context.vehicle,      context.c_space};
  const double over_unknown_m =
      progress_over_unknown_m(lattice, start, goals, if_open, min_progress_m);
  const bool unknown = over_unknown_m >= min_progress_m;
  const bool narrow =
      !unknown && fits_without_margins(lattice, start, goals, if_open,
                                       std::max(min_progress_m, over_unknown_m + kPassedM));

  PlannedPath path;
  path.outcome = unknown  ? PlanOutcome::kUnknown
                 : narrow ? PlanOutcome::kNarrow
                          : PlanOutcome::kBlocked;
  path.reached_m = region.progress_m;
  path.blocking = blocking_cells(region, lattice, goals, evidence);
  const auto deciding = cells_in_lane(path.blocking, region, goals, lattice.space, context);
  path.reason = fmt::format("No path: blocked by {} after {:.1f} m towards the goal{}.",
                            main_reason(deciding), region.progress_m,
                            narrow ? ", but the robot may just fit" : "");
  return {path, cells_of(region, lattice.space)};
}

}  // namespace adit
