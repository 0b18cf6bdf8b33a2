// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/planning.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "procs/planning/blocking_evidence.hpp"
#include "procs/planning/c_space/unobserved_ground.hpp"
#include "procs/planning/goals/retrace.hpp"
#include "procs/planning/lattice/cell_heuristic.hpp"
#include "procs/planning/lattice/lattice.hpp"
#include "procs/planning/path_points.hpp"

namespace adit {
namespace {

constexpr double kDefaultCellM = 0.1;
// Beyond what is in the way. A smaller robot gets nearer to a wall, but not through it.
constexpr double kPassedM = 1.0;

void check(const TerrainMap& terrain) {
  const bool sized = terrain.columns > 0 && terrain.rows > 0 && terrain.cell_m > 0.0 &&
                     terrain.cells.size() == static_cast<std::size_t>(terrain.columns) *
                                                 static_cast<std::size_t>(terrain.rows);
  if (!sized) throw std::invalid_argument("the terrain map has not the cells that it says");
}

/// "after 1.3 m towards the goal"
std::string progress_text(double reached_m) {
  char text[64];
  std::snprintf(text, sizeof text, "after %.1f m towards the goal", reached_m);
  return text;
}

const char* name_of(BlockingCell::Reason reason) {
  switch (reason) {
    case BlockingCell::Reason::kStep:
      return "a step under the wheels";
    case BlockingCell::Reason::kBelly:
      return "an obstacle that is too high to drive over";
    case BlockingCell::Reason::kRoof:
      return "a roof that is too low";
    case BlockingCell::Reason::kUnknown:
      return "ground that was not seen";
    case BlockingCell::Reason::kWater:
      return "what may be water";
    case BlockingCell::Reason::kSlope:
      return "a slope that is too steep";
    case BlockingCell::Reason::kDrop:
      return "a drop";
  }
  return "";
}

/// What most of the cells are.
std::string main_reason(const std::vector<BlockingCell>& cells) {
  int counts[7] = {};
  std::size_t most = 0;
  for (const BlockingCell& cell : cells) {
    const auto i = static_cast<std::size_t>(cell.reason);
    if (++counts[i] > counts[most]) most = i;
  }
  if (cells.empty()) return "the edge of the map";
  return name_of(static_cast<BlockingCell::Reason>(most));
}

std::vector<std::uint8_t> cells_of(const ReachableRegion& region, const CSpace& space) {
  std::vector<std::uint8_t> reached(space.cells(), 0);
  for (const LatticePose& pose : region.poses) reached[space.index(pose.column, pose.row)] = 1;
  return reached;
}

PlannedPath start_blocked(const LatticePose& start, const Lattice& lattice,
                          const EvidenceContext& context) {
  PlannedPath path;
  path.outcome = PlanOutcome::kStartBlocked;
  if (!lattice.space.contains(start.column, start.row)) {
    path.reason = "The robot is not on the terrain map.";
    return path;
  }
  path.blocking = blocking_cells(start, lattice, context);
  path.reason = "The robot cannot stand where it is: " + main_reason(path.blocking) + ".";
  return path;
}

GroundLimits without_margins(GroundLimits limits) {
  limits.step_margin_m = limits.belly_margin_m = limits.roof_margin_m = 0.0;
  return limits;
}

/// The regions of the terrain reach a cell beyond what stands in them: so much of a gap is missing
/// on either side, and with a smaller vehicle it is not.
Vehicle without_region_margin(Vehicle vehicle, double cell_m) {
  vehicle.length_m -= 2.0 * cell_m;
  vehicle.width_m -= 2.0 * cell_m;
  vehicle.track_m -= 2.0 * cell_m;
  return vehicle;
}

/// What was not seen may be a way on, but no way leads back from where the robot is, to where this
/// look did not reach, and round through the rock: behind it, beside its route, that is lethal.
CSpace unknown_ahead_only(CSpace space, const TerrainMap& terrain, const GoalField& goals,
                          const Eigen::Vector2d& p_level_body) {
  const Eigen::Vector2d ahead = goals.direction(p_level_body);
  for (int row = 0; row < space.rows(); ++row) {
    for (int column = 0; column < space.columns(); ++column) {
      const bool continues_beyond = goals.progress(space.index(column, row)) > 0.0;
      if (continues_beyond || ahead.dot(terrain.centre(column, row) - p_level_body) >= 0.0)
        continue;
      for (int heading = 0; heading < space.headings() / 2; ++heading) {
        std::uint16_t& cost = space.slice(heading)[space.index(column, row)];
        if (cost == CSpace::kUnknown) cost = CSpace::kLethal;
      }
    }
  }
  return space;
}

bool is_goal_behind(const GoalField& goals, const Pose2& T_level_body) {
  const Eigen::Vector2d ahead(std::cos(T_level_body.theta), std::sin(T_level_body.theta));
  return ahead.dot(goals.direction(T_level_body.translation())) < 0.0;
}

}  // namespace

Planning::Planning(const PlanningParams& params) : params_(params) {
  // What does not fit together is to be said before the first plan, at any usual size of cells.
  prepare_for(kDefaultCellM);
  if (params.goals.shortfall_factor <= 1.0 + params.c_space.rough_factor) {
    throw std::invalid_argument(
        "planning.goals.shortfall_factor must exceed 1 + planning.c_space.rough_factor, or a path "
        "over rough ground does not pay");
  }
}

void Planning::prepare_for(double cell_m) {
  if (kernels_ && kernels_->cell_m() == cell_m) return;
  kernels_.emplace(params_.vehicle, params_.c_space, cell_m);
  front_leading_.emplace(params_.vehicle, params_.primitives, kernels_->headings(), cell_m);
  rear_leading_ = front_leading_->rear_leading(params_.primitives.reverse_factor);
}

const MotionPrimitives& Planning::primitives() const {
  return drives_rear_first_ ? *rear_leading_ : *front_leading_;
}

void Planning::prepare(const TerrainMap& terrain, const Pose2& T_odom_body) {
  check(terrain);
  const Pose2 T_level_body = between(terrain.T_odom_level, T_odom_body);
  prepare_for(terrain.cell_m);
  GroundLayers layers =
      ground_layers(terrain, T_level_body, params_.vehicle, params_.c_space.ground);
  CSpace space = kernels_->convolve(layers);
  ExactCheck exact_check(layers, primitives().reach());
  ground_.emplace(PlanGround{std::move(layers), std::move(space), std::move(exact_check), {}});
}

Lattice Planning::lattice(std::uint16_t cost_limit) const {
  return {ground_->space, primitives(), cost_limit, &ground_->exact_check};
}

bool Planning::is_valid(const LatticePose& pose) const {
  const Lattice free = lattice(CSpace::kUnknown);
  const auto& kernel = kernels_->oriented(pose.heading);
  return free.is_valid(pose) &&
         free.allows(kernel.exact_body, kernel.exact_wheels, pose.column, pose.row);
}

PlannedPath Planning::plan(const TerrainMap& terrain, const PlanGoal& goal,
                           const Pose2& T_odom_body) {
  prepare(terrain, T_odom_body);
  return find(terrain, goal, T_odom_body);
}

PlannedPath Planning::find(const TerrainMap& terrain, const PlanGoal& goal,
                           const Pose2& T_odom_body) {
  const Pose2 T_level_body = between(terrain.T_odom_level, T_odom_body);
  const HeadingSet& headings = kernels_->headings();
  const GoalField goals(goal, between(terrain.T_odom_level, goal.T_odom_goal), T_level_body,
                        terrain, params_.goals, ground_->layers.body_distance_m);
  drives_rear_first_ = is_goal_behind(goals, T_level_body);
  const LatticePose start = nearest_pose(terrain, headings, T_level_body);
  const Lattice free = lattice(CSpace::kUnknown);
  if (!is_valid(start)) {
    const double at_the_limit = CSpace::kEven * (1.0 + params_.c_space.rough_factor);
    clear_start(ground_->space, start, ground_->layers, *kernels_,
                static_cast<std::uint16_t>(at_the_limit));
  }
  const auto heuristic = cell_heuristic(free, goals, terrain.cell_m);
  const LatticePath found = search_lattice(free, headings, start, goals, heuristic, params_.search);

  PlannedPath path;
  if (found.found) {
    path.outcome = PlanOutcome::kFound;
    path.points = path_points(found, start, primitives(), headings, terrain, ground_->layers,
                              params_.vehicle, params_.point_spacing_m);
    // It stands there, and the pose of the lattice is nearer than the slack of a cell.
    path.points.front().T_odom_body = T_odom_body;
    const Pose2 T_level_end = between(terrain.T_odom_level, path.points.back().T_odom_body);
    path.reached_m = goals.progress(T_level_end.translation());
    path.reason = "A path was found.";
    const bool along_route =
        goal.kind == PlanGoal::Kind::kRoute || goal.kind == PlanGoal::Kind::kRouteTo;
    if (along_route && goals.continues_beyond(T_level_end.translation())) {
      trim_to_clear_end(path, terrain, headings, lattice(CSpace::kLethal), goals, params_.vehicle);
    }
    if (goal.kind == PlanGoal::Kind::kRejoin) {
      append_traversed_path(path, goal);
      if (path.points.size() < 2) return retrace(goal, T_odom_body);
    }
  } else if (goal.kind == PlanGoal::Kind::kRejoin) {
    return retrace(goal, T_odom_body);
  } else if (found.abandoned) {
    path.outcome = PlanOutcome::kSearchLimit;
    path.reason = "The search was cut off by its limit.";
  } else {
    path = explain_no_path(terrain, T_level_body, start, goals);
  }
  path.utime = terrain.utime;
  path.id = goal.id;
  return path;
}

PlannedPath Planning::explain_no_path(const TerrainMap& terrain, const Pose2& T_level_body,
                                      const LatticePose& start, const GoalField& goals) {
  const Lattice free = lattice(CSpace::kUnknown);
  const EvidenceContext context{terrain, ground_->layers, *kernels_, params_.vehicle,
                                params_.c_space.ground};
  if (!free.is_valid(start)) return start_blocked(start, free, context);
  const ReachableRegion region = reachable_region(free, start, goals);
  ground_->reached = cells_of(region, ground_->space);
  const double least = goals.min_progress();
  const CSpace ahead =
      unknown_ahead_only(ground_->space, terrain, goals, T_level_body.translation());
  const ReachableRegion with_unknown = reachable_region(
      {ahead, primitives(), CSpace::kLethal, &ground_->exact_check}, start, goals, least);
  PlannedPath path;
  const bool unknown = with_unknown.progress_m >= least;
  const bool fits_without_margins =
      !unknown && may_fit_without_margins(terrain, T_level_body, start, goals,
                                          std::max(least, with_unknown.progress_m + kPassedM));
  path.outcome = unknown                ? PlanOutcome::kUnknown
                 : fits_without_margins ? PlanOutcome::kNarrow
                                        : PlanOutcome::kBlocked;
  path.reached_m = region.progress_m;
  path.blocking = blocking_cells(region, free, goals, context);
  path.reason = "No path: " + main_reason(path.blocking) + " is in the way " +
                progress_text(region.progress_m) +
                (fits_without_margins ? ", but the robot may just fit." : ".");
  return path;
}

/// Margins are there to drive safely, and cells and the regions of the terrain take away as much
/// again, to each side of a gap a cell for the region, one for where the point lies in its cell.
/// What is in the way by these alone, or by drops that nobody saw, does not show that there is no
/// way.
bool Planning::may_fit_without_margins(const TerrainMap& terrain, const Pose2& T_level_body,
                                       const LatticePose& start, const GoalField& goals,
                                       double enough_m) const {
  const GroundLimits limits = without_margins(params_.c_space.ground);
  const TerrainMap seen = with_confirmed_drops(terrain, params_.vehicle.step_max_m);
  const CSpaceKernels kernels(without_region_margin(params_.vehicle, terrain.cell_m),
                              params_.c_space, terrain.cell_m);
  const CSpace space = unknown_ahead_only(
      kernels.convolve(ground_layers(seen, T_level_body, params_.vehicle, limits)), terrain, goals,
      T_level_body.translation());
  const Lattice less_cells{space, primitives(), CSpace::kLethal, nullptr, true};
  return reachable_region(less_cells, start, goals, enough_m).progress_m >= enough_m;
}

}  // namespace adit
