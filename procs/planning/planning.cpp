// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/planning.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "procs/planning/cell_heuristic.hpp"
#include "procs/planning/evidence.hpp"
#include "procs/planning/path_end.hpp"
#include "procs/planning/path_points.hpp"
#include "procs/planning/reachable.hpp"
#include "procs/planning/retrace.hpp"
#include "procs/planning/seen_drops.hpp"
#include "procs/planning/start_pose.hpp"

namespace adit {
namespace {

constexpr double kUsualCellM = 0.1;
// Beyond what is in the way. A smaller robot gets nearer to a wall, but not through it.
constexpr double kThroughM = 1.0;

void check(const TerrainMap& terrain) {
  const bool sized = terrain.columns > 0 && terrain.rows > 0 && terrain.cell_m > 0.0 &&
                     terrain.cells.size() == static_cast<std::size_t>(terrain.columns) *
                                                 static_cast<std::size_t>(terrain.rows);
  if (!sized) throw std::invalid_argument("the terrain map has not the cells that it says");
}

/// "after 1.3 m towards the goal"
std::string after(double reached_m) {
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
std::string most_of(const std::vector<BlockingCell>& cells) {
  int counts[7] = {};
  std::size_t most = 0;
  for (const BlockingCell& cell : cells) {
    const auto i = static_cast<std::size_t>(cell.reason);
    if (++counts[i] > counts[most]) most = i;
  }
  if (cells.empty()) return "the edge of the map";
  return name_of(static_cast<BlockingCell::Reason>(most));
}

std::vector<std::uint8_t> cells_of(const Reachable& region, const CSpace& space) {
  std::vector<std::uint8_t> reached(space.cells(), 0);
  for (const LatticePose& pose : region.poses) reached[space.index(pose.column, pose.row)] = 1;
  return reached;
}

PlannedPath start_blocked(const LatticePose& start, const Lattice& lattice,
                          const Grounds& grounds) {
  PlannedPath answer;
  answer.outcome = PlanOutcome::kStartBlocked;
  if (!lattice.space.contains(start.column, start.row)) {
    answer.reason = "The robot is not on the terrain map.";
    return answer;
  }
  answer.blocking = blocking_cells(start, lattice, grounds);
  answer.reason = "The robot cannot stand where it is: " + most_of(answer.blocking) + ".";
  return answer;
}

GroundLimits without_margins(GroundLimits limits) {
  limits.step_margin_m = limits.belly_margin_m = limits.roof_margin_m = 0.0;
  return limits;
}

/// The regions of the terrain reach a cell beyond what stands in them: so much of a gap is missing
/// on either side, and with a smaller vehicle it is not.
Vehicle less_regions(Vehicle vehicle, double cell_m) {
  vehicle.length_m -= 2.0 * cell_m;
  vehicle.width_m -= 2.0 * cell_m;
  vehicle.track_m -= 2.0 * cell_m;
  return vehicle;
}

/// What was not seen may be a way on, but no way leads back from where the robot is, to where this
/// look did not reach, and round through the rock: behind it, beside its route, that is lethal.
CSpace unseen_ahead_only(CSpace space, const TerrainMap& terrain, const GoalField& goals,
                         const Eigen::Vector2d& p_level_body) {
  const Eigen::Vector2d ahead = goals.direction(p_level_body);
  for (int row = 0; row < space.rows(); ++row) {
    for (int column = 0; column < space.columns(); ++column) {
      const bool leads_on = goals.progress(space.index(column, row)) > 0.0;
      if (leads_on || ahead.dot(terrain.centre(column, row) - p_level_body) >= 0.0) continue;
      for (int heading = 0; heading < space.headings() / 2; ++heading) {
        std::uint16_t& cost = space.slice(heading)[space.index(column, row)];
        if (cost == CSpace::kUnseen) cost = CSpace::kLethal;
      }
    }
  }
  return space;
}

bool is_behind(const GoalField& goals, const Pose2& T_level_body) {
  const Eigen::Vector2d ahead(std::cos(T_level_body.theta), std::sin(T_level_body.theta));
  return ahead.dot(goals.direction(T_level_body.translation())) < 0.0;
}

}  // namespace

Planning::Planning(const PlanningParams& params) : params_(params) {
  // What does not fit together is to be said before the first plan, at any usual size of cells.
  prepare_for(kUsualCellM);
  if (params.goals.shortfall_factor <= 1.0 + params.c_space.rough_factor) {
    throw std::invalid_argument(
        "planning.goals.shortfall_factor must exceed 1 + planning.c_space.rough_factor, or a path "
        "over rough ground does not pay");
  }
}

void Planning::prepare_for(double cell_m) {
  if (kernels_ && kernels_->cell_m() == cell_m) return;
  kernels_.emplace(params_.vehicle, params_.c_space, cell_m);
  front_leads_.emplace(params_.vehicle, params_.primitives, kernels_->headings(), cell_m);
  rear_leads_ = front_leads_->led_by_rear(params_.primitives.reverse_factor);
}

const MotionPrimitives& Planning::primitives() const {
  return goes_back_ ? *rear_leads_ : *front_leads_;
}

void Planning::prepare(const TerrainMap& terrain, const Pose2& T_odom_body) {
  check(terrain);
  const Pose2 T_level_body = between(terrain.T_odom_level, T_odom_body);
  prepare_for(terrain.cell_m);
  GroundLayers layers =
      ground_layers(terrain, T_level_body, params_.vehicle, params_.c_space.ground);
  CSpace space = kernels_->convolve(layers);
  CloseLook close_look(layers, primitives().reach());
  ground_.emplace(PlanGround{std::move(layers), std::move(space), std::move(close_look), {}});
}

Lattice Planning::lattice(std::uint16_t refused) const {
  return {ground_->space, primitives(), refused, &ground_->close_look};
}

bool Planning::stands(const LatticePose& pose) const {
  const Lattice free = lattice(CSpace::kUnseen);
  const auto& kernel = kernels_->oriented(pose.heading);
  return free.stands(pose) &&
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
  goes_back_ = is_behind(goals, T_level_body);
  const LatticePose start = nearest_pose(terrain, headings, T_level_body);
  const Lattice free = lattice(CSpace::kUnseen);
  if (!stands(start)) {
    const double at_the_limit = CSpace::kEven * (1.0 + params_.c_space.rough_factor);
    allow_leaving(ground_->space, start, ground_->layers, *kernels_,
                  static_cast<std::uint16_t>(at_the_limit));
  }
  const auto heuristic = cell_heuristic(free, goals, terrain.cell_m);
  const LatticePath found = search_lattice(free, headings, start, goals, heuristic, params_.search);

  PlannedPath answer;
  if (found.found) {
    answer.outcome = PlanOutcome::kFound;
    answer.points = path_points(found, start, primitives(), headings, terrain, ground_->layers,
                                params_.vehicle, params_.point_spacing_m);
    // It stands there, and the pose of the lattice is nearer than the slack of a cell.
    answer.points.front().T_odom_body = T_odom_body;
    const Pose2 T_level_end = between(terrain.T_odom_level, answer.points.back().T_odom_body);
    answer.reached_m = goals.progress(T_level_end.translation());
    answer.reason = "A path was found.";
    const bool along_route =
        goal.kind == PlanGoal::Kind::kRoute || goal.kind == PlanGoal::Kind::kRouteTo;
    if (along_route && goals.leads_on(T_level_end.translation())) {
      end_with_room(answer, terrain, headings, lattice(CSpace::kLethal), goals, params_.vehicle);
    }
    if (goal.kind == PlanGoal::Kind::kRejoin) {
      go_on_along_track(answer, goal);
      if (answer.points.size() < 2) return retrace(goal, T_odom_body);
    }
  } else if (goal.kind == PlanGoal::Kind::kRejoin) {
    return retrace(goal, T_odom_body);
  } else if (found.gave_up) {
    answer.outcome = PlanOutcome::kGaveUp;
    answer.reason = "The search was cut off by its limit.";
  } else {
    answer = no_path(terrain, T_level_body, start, goals);
  }
  answer.utime = terrain.utime;
  answer.id = goal.id;
  return answer;
}

PlannedPath Planning::no_path(const TerrainMap& terrain, const Pose2& T_level_body,
                              const LatticePose& start, const GoalField& goals) {
  const Lattice free = lattice(CSpace::kUnseen);
  const Grounds grounds{terrain, ground_->layers, *kernels_, params_.vehicle,
                        params_.c_space.ground};
  if (!free.stands(start)) return start_blocked(start, free, grounds);
  const Reachable region = reachable(free, start, goals);
  ground_->reached = cells_of(region, ground_->space);
  const double least = goals.least_progress();
  const CSpace ahead =
      unseen_ahead_only(ground_->space, terrain, goals, T_level_body.translation());
  const Reachable seen_or_not =
      reachable({ahead, primitives(), CSpace::kLethal, &ground_->close_look}, start, goals, least);
  PlannedPath answer;
  const bool unseen = seen_or_not.progress_m >= least;
  const bool just_fits =
      !unseen && may_just_fit(terrain, T_level_body, start, goals,
                              std::max(least, seen_or_not.progress_m + kThroughM));
  answer.outcome = unseen      ? PlanOutcome::kUnknown
                   : just_fits ? PlanOutcome::kNarrow
                               : PlanOutcome::kBlocked;
  answer.reached_m = region.progress_m;
  answer.blocking = blocking_cells(region, free, goals, grounds);
  answer.reason = "No path: " + most_of(answer.blocking) + " is in the way " +
                  after(region.progress_m) + (just_fits ? ", but the robot may just fit." : ".");
  return answer;
}

/// Margins are there to drive safely, and cells and the regions of the terrain take away as much
/// again, to each side of a gap a cell for the region, one for where the point lies in its cell.
/// What is in the way by these alone, or by drops that nobody saw, does not show that there is no
/// way.
bool Planning::may_just_fit(const TerrainMap& terrain, const Pose2& T_level_body,
                            const LatticePose& start, const GoalField& goals,
                            double enough_m) const {
  const GroundLimits limits = without_margins(params_.c_space.ground);
  const TerrainMap seen = with_seen_drops(terrain, params_.vehicle.step_max_m);
  const CSpaceKernels kernels(less_regions(params_.vehicle, terrain.cell_m), params_.c_space,
                              terrain.cell_m);
  const CSpace space = unseen_ahead_only(
      kernels.convolve(ground_layers(seen, T_level_body, params_.vehicle, limits)), terrain, goals,
      T_level_body.translation());
  const Lattice less_cells{space, primitives(), CSpace::kLethal, nullptr, true};
  return reachable(less_cells, start, goals, enough_m).progress_m >= enough_m;
}

}  // namespace adit
