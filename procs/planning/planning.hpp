// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/types/planned_path.hpp"
#include "common/types/terrain_map.hpp"
#include "common/types/vehicle.hpp"
#include "procs/planning/c_space/c_space.hpp"
#include "procs/planning/goals/goal_field.hpp"
#include "procs/planning/lattice/lattice.hpp"
#include "procs/planning/lattice/lattice_search.hpp"
#include "procs/planning/lattice/motion_primitives.hpp"

namespace adit {

struct PlanningParams {
  Vehicle vehicle;
  CSpaceParams c_space;
  PrimitiveParams primitives;
  GoalParams goals;
  SearchParams search;
  double point_spacing_m = 0.15;  ///< of the path

  template <class V>
  void visit(V& v) {
    v.shared(Vehicle::kSection, vehicle);
    v("c_space", c_space);
    v("primitives", primitives);
    v("goals", goals);
    v("search", search);
    v("point_spacing_m", point_spacing_m, above_up_to(0.0, 1.0));
  }
};

/// What a plan rests on, for those who want to look at it.
struct PlanGround {
  GroundLayers layers;
  CSpace space;
  ExactCheck exact_check;
  std::vector<std::uint8_t> reached;  ///< 1: the robot's middle can get there; empty with a path
};

/// Finds a path over the terrain of one 3D scan: C-space maps by oriented kernels and A* in them
/// (the paper's sections 3.2 and 3.3).
class Planning {
 public:
  /// Throws std::invalid_argument where the vehicle cannot be planned for.
  explicit Planning(const PlanningParams& params);

  /// A path from where the robot is, or why there is none. It is planned from the pose of the
  /// lattice nearest to the robot: within half a cell and half a heading. Throws
  /// std::invalid_argument where the map has other cells than it says, or cells that are too small
  /// or too large for the vehicle; a goal or a pose with no place is answered.
  PlannedPath plan(const TerrainMap& terrain, const PlanGoal& goal, const Pose2& T_odom_body);

  // The two halves of it, for those who want to know how long each takes. The first throws as
  // `plan` does; the second takes what the first was given.
  void prepare(const TerrainMap& terrain, const Pose2& T_odom_body);
  PlannedPath find(const TerrainMap& terrain, const PlanGoal& goal, const Pose2& T_odom_body);

  /// What the last plan rested on.
  [[nodiscard]] const std::optional<PlanGround>& ground() const { return ground_; }
  /// Those of the last plan; before, for cells of the usual size.
  [[nodiscard]] const std::optional<CSpaceKernels>& kernels() const { return kernels_; }

 private:
  void prepare_for(double cell_m);
  [[nodiscard]] const MotionPrimitives& primitives() const;
  [[nodiscard]] Lattice lattice(std::uint16_t cost_limit) const;
  [[nodiscard]] bool is_valid(const LatticePose& pose) const;
  PlannedPath explain_no_path(const TerrainMap& terrain, const Pose2& T_level_body,
                              const LatticePose& start, const GoalField& goals);
  [[nodiscard]] bool may_fit_without_margins(const TerrainMap& terrain, const Pose2& T_level_body,
                                             const LatticePose& start, const GoalField& goals,
                                             double enough_m) const;

  PlanningParams params_;
  std::optional<CSpaceKernels> kernels_;
  // With the front leading, to goals ahead, and the rear, to those behind the robot.
  std::optional<MotionPrimitives> front_leading_;
  std::optional<MotionPrimitives> rear_leading_;
  bool drives_rear_first_ = false;
  std::optional<PlanGround> ground_;
};

}  // namespace adit
