// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/planning.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "procs/planning/goals/retrace.hpp"
#include "procs/planning/lattice/cell_heuristic.hpp"
#include "procs/planning/lattice/lattice.hpp"
#include "procs/planning/no_path.hpp"
#include "procs/planning/path_points.hpp"

namespace adit {
namespace {

constexpr double kDefaultCellM = 0.1;
constexpr double kEnoughM = 0.25;  // of clearance; driving slows down from 0.15 m on

void check(const TerrainMap& terrain) {
  if (terrain.cells.box().empty()) throw std::invalid_argument("the terrain map has no cells");
  if (!(terrain.cell_m > 0.0)) {
    throw std::invalid_argument("the cell size of the terrain map is not positive");
  }
}

bool is_behind(const GoalField& goals, const Pose2& T_level_body) {
  const Eigen::Vector2d ahead(std::cos(T_level_body.theta), std::sin(T_level_body.theta));
  return ahead.dot(goals.direction(T_level_body.translation())) < 0.0;
}

}  // namespace

Planning::Planning(const PlanningParams& params) : params_(params) {
  // Reports inconsistent parameters before the first plan.
  make_kernels(kDefaultCellM);
  if (params.goals.shortfall_factor <= 1.0 + params.c_space.rough_factor) {
    throw std::invalid_argument(
        "planning.goals.shortfall_factor must exceed 1 + planning.c_space.rough_factor, or a path "
        "over rough ground does not pay");
  }
}

void Planning::make_kernels(double cell_m) {
  if (kernels_ && kernels_->cell_m() == cell_m) return;
  kernels_.emplace(params_.vehicle, params_.c_space, cell_m);
  front_leading_.emplace(params_.vehicle, params_.primitives, kernels_->headings(), cell_m);
  rear_leading_ = front_leading_->rear_leading(params_.primitives.reverse_factor);
}

PlannedPath Planning::plan(const TerrainMap& terrain, const PlanGoal& goal,
                           const Pose2& T_odom_body) {
  prepare(terrain, T_odom_body);
  return find(terrain, goal, T_odom_body);
}

PlannedPath Planning::retraced(const PlanGoal& goal, const Pose2& T_odom_body) const {
  return retrace(goal, T_odom_body, params_.vehicle.turning_radius_m);
}

void Planning::prepare(const TerrainMap& terrain, const Pose2& T_odom_body) {
  check(terrain);
  const Pose2 T_level_body = between(terrain.T_odom_level, T_odom_body);
  make_kernels(terrain.cell_m);
  GroundLayers layers =  // section 3.1: the navigational coefficient and what derives from it
      ground_layers(terrain, T_level_body, params_.vehicle, params_.c_space.ground);
  CSpace space = kernels_->convolve(layers);  // section 3.2: convolution with oriented kernels
  ExactCheck exact_check(layers, primitives().reach());
  ground_.emplace(PlanGround{std::move(layers), std::move(space), std::move(exact_check), {}});
}

PlannedPath Planning::find(const TerrainMap& terrain, const PlanGoal& goal,
                           const Pose2& T_odom_body) {
  const Pose2 T_level_body = between(terrain.T_odom_level, T_odom_body);
  const GoalField goals(goal, between(terrain.T_odom_level, goal.T_odom_goal), T_level_body,
                        terrain, params_.goals, ground_->layers.body_distance_m);
  // Without a rear laser the robot turns round: no scan shows the ground behind it.
  is_goal_behind_ = params_.lasers.has_rear() && is_behind(goals, T_level_body);
  const LatticePose start = nearest_pose(terrain, kernels_->headings(), T_level_body);
  clear_blocked_start(start);
  const LatticePath found = search(start, goals, terrain.cell_m);  // section 3.3

  PlannedPath path;
  if (found.found) {
    path = make_path(found, start, terrain, goal, goals, T_odom_body);
  } else if (auto narrow = passage(terrain, goal, goals, T_level_body)) {
    path = std::move(*narrow);
  } else if (found.abandoned) {
    path.outcome = PlanOutcome::kSearchLimit;
    path.reason = "The search reached its maximum number of expansions.";
  } else if (goal.kind != PlanGoal::Kind::kRejoin) {
    path = explain(terrain, T_level_body, start, goals);
  }
  // If no scan shows a path onto the traversed path, the robot retraces it from where it is.
  if (goal.kind == PlanGoal::Kind::kRejoin && path.points.size() < 2) {
    return retraced(goal, T_odom_body);
  }
  path.utime = terrain.utime;
  path.id = goal.id;
  return path;
}

const MotionPrimitives& Planning::primitives() const {
  return is_goal_behind_ ? *rear_leading_ : *front_leading_;
}

Lattice Planning::lattice(std::uint16_t cost_limit) const {
  return {ground_->space, primitives(), cost_limit, &ground_->exact_check};
}

bool Planning::is_valid_start(const LatticePose& start) const {
  const Lattice free = lattice(CSpace::kUnknown);
  const auto& kernel = kernels_->oriented(start.heading);
  return free.is_valid(start) &&
         free.allows(kernel.exact_body, kernel.exact_wheels, start.column, start.row);
}

void Planning::clear_blocked_start(const LatticePose& start) {
  if (is_valid_start(start)) return;
  const double limit_cost = kEvenCost * (1.0 + params_.c_space.rough_factor);
  clear_start(ground_->space, start, ground_->layers, *kernels_,
              static_cast<std::uint16_t>(limit_cost));
}

LatticePath Planning::search(const LatticePose& start, const GoalField& goals,
                             double cell_m) const {
  const Lattice free = lattice(CSpace::kUnknown);
  const auto heuristic = cell_heuristic(free, goals, cell_m);
  return search_lattice(free, kernels_->headings(), start, goals, heuristic, params_.search);
}

PlannedPath Planning::make_path(const LatticePath& found, const LatticePose& start,
                                const TerrainMap& terrain, const PlanGoal& goal,
                                const GoalField& goals, const Pose2& T_odom_body) const {
  PlannedPath path;
  path.outcome = PlanOutcome::kFound;
  path.reason = "A path was found.";
  path.points = path_points(found, start, primitives(), kernels_->headings(), terrain,
                            ground_->layers, params_.vehicle, params_.point_spacing_m);
  // The path starts at the robot, which is within the margins of the start pose of the lattice.
  path.points.front().T_odom_body = T_odom_body;
  const Pose2 T_level_end = between(terrain.T_odom_level, path.points.back().T_odom_body);
  path.reached_m = goals.progress(T_level_end.translation());
  const bool along_route =
      goal.kind == PlanGoal::Kind::kRoute || goal.kind == PlanGoal::Kind::kRouteTo;
  if (along_route && goals.continues_beyond(T_level_end.translation())) {
    trim_to_clear_end(path, terrain, kernels_->headings(), lattice(CSpace::kLethal), goals,
                      params_.vehicle);
  }
  if (std::any_of(path.points.begin(), path.points.end(),
                  [](const PathPoint& point) { return point.clearance_m <= kEnoughM; })) {
    const Pose2 T_level_body = between(terrain.T_odom_level, T_odom_body);
    refine_clearance(path, kEnoughM, terrain, ground_->layers, wall_distance(terrain, T_level_body),
                     params_.vehicle);
  }
  if (goal.kind == PlanGoal::Kind::kRejoin)
    append_traversed_path(path, goal, params_.vehicle.turning_radius_m);
  return path;
}

WallDistance Planning::wall_distance(const TerrainMap& terrain, const Pose2& T_level_body) const {
  return {terrain,         ground_->layers,        T_level_body,
          params_.vehicle, params_.c_space.ground, params_.lasers.front.height_m};
}

std::optional<PlannedPath> Planning::passage(const TerrainMap& terrain, const PlanGoal& goal,
                                             const GoalField& goals,
                                             const Pose2& T_level_body) const {
  const bool along = goal.kind == PlanGoal::Kind::kAlong || goal.kind == PlanGoal::Kind::kRoute ||
                     goal.kind == PlanGoal::Kind::kRouteTo;
  if (!along) return std::nullopt;
  return plan_passage(terrain, wall_distance(terrain, T_level_body), goals, T_level_body,
                      is_goal_behind_, params_.vehicle, params_.passage);
}

PlannedPath Planning::explain(const TerrainMap& terrain, const Pose2& T_level_body,
                              const LatticePose& start, const GoalField& goals) {
  NoPathExplanation explanation = explain_no_path(
      lattice(CSpace::kUnknown), start, goals,
      {terrain, T_level_body, ground_->layers, *kernels_, params_.vehicle, params_.c_space});
  ground_->reached = std::move(explanation.reached);
  return std::move(explanation.path);
}

}  // namespace adit
