// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/types/planned_path.hpp"
#include "common/types/terrain_map.hpp"
#include "common/types/vehicle.hpp"
#include "procs/planning/c_space/c_space.hpp"
#include "procs/planning/goals/goal_field.hpp"
#include "procs/planning/lattice/lattice.hpp"
#include "procs/planning/lattice/lattice_search.hpp"
#include "procs/planning/lattice/motion_primitives.hpp"
#include "procs/planning/passage/passage.hpp"
#include "procs/planning/passage/wall_distance.hpp"

namespace adit {

struct PlanningParams {
  Lasers lasers;
  Vehicle vehicle;
  CSpaceParams c_space;
  PrimitiveParams primitives;
  GoalParams goals;
  SearchParams search;
  PassageParams passage;
  double point_spacing_m = 0.15;  ///< of the points of a path

  template <class V>
  void visit(V& v) {
    v.shared(Lasers::kSection, lasers);
    v.shared(Vehicle::kSection, vehicle);
    v("c_space", c_space);
    v("primitives", primitives);
    v("goals", goals);
    v("search", search);
    v("passage", passage);
    v("point_spacing_m", point_spacing_m, above_up_to(0.0, 1.0));
  }
};

/// The maps of the last plan, for pictures and measurements.
struct PlanGround {
  GroundLayers layers;
  CSpace space;
  ExactCheck exact_check;
  /// For each cell, 1 where the centre of the robot can get; empty if a path was found.
  std::vector<std::uint8_t> reached;
};

/// Plans a path over the terrain of one 3D scan: C-space maps by oriented kernels (section 3.2 of
/// the paper) and A* in a lattice of motion primitives (section 3.3).
class Planning {
 public:
  /// Throws std::invalid_argument if the parameters do not allow to plan for the vehicle.
  explicit Planning(const PlanningParams& params);

  /// A path from the robot, or the reason why there is none. The search starts at the lattice pose
  /// nearest to the robot, within half a cell and half a heading. Throws std::invalid_argument if
  /// the terrain map has no cells, or cells that are too small or too large for the vehicle. A goal
  /// or pose outside the map is no error, but yields a reason.
  PlannedPath plan(const TerrainMap& terrain, const PlanGoal& goal, const Pose2& T_odom_body);
  /// A path over the traversed path, see retrace().
  [[nodiscard]] PlannedPath retraced(const PlanGoal& goal, const Pose2& T_odom_body) const;

  // The two steps of plan(), separately for measurements. find() needs the arguments of the
  // preceding prepare(), which throws as plan() does.
  /// C-space maps (section 3.2).
  void prepare(const TerrainMap& terrain, const Pose2& T_odom_body);
  /// Search, then the path or an explanation (section 3.3).
  PlannedPath find(const TerrainMap& terrain, const PlanGoal& goal, const Pose2& T_odom_body);

  /// The maps of the last plan.
  [[nodiscard]] const std::optional<PlanGround>& ground() const { return ground_; }
  /// The kernels of the last plan; before the first one, for the default cell size.
  [[nodiscard]] const std::optional<CSpaceKernels>& kernels() const { return kernels_; }

 private:
  void make_kernels(double cell_m);
  [[nodiscard]] const MotionPrimitives& primitives() const;
  [[nodiscard]] Lattice lattice(std::uint16_t cost_limit) const;
  [[nodiscard]] bool is_valid_start(const LatticePose& start) const;
  void clear_blocked_start(const LatticePose& start);
  [[nodiscard]] LatticePath search(const LatticePose& start, const GoalField& goals,
                                   double cell_m) const;
  [[nodiscard]] PlannedPath make_path(const LatticePath& found, const LatticePose& start,
                                      const TerrainMap& terrain, const PlanGoal& goal,
                                      const GoalField& goals, const Pose2& T_odom_body) const;
  /// A path through a narrow passage, where the lattice has none.
  [[nodiscard]] std::optional<PlannedPath> passage(const TerrainMap& terrain, const PlanGoal& goal,
                                                   const GoalField& goals,
                                                   const Pose2& T_level_body) const;
  /// The walls of the last prepare(), at the resolution of CellParts.
  [[nodiscard]] WallDistance wall_distance(const TerrainMap& terrain,
                                           const Pose2& T_level_body) const;
  PlannedPath explain(const TerrainMap& terrain, const Pose2& T_level_body,
                      const LatticePose& start, const GoalField& goals);

  PlanningParams params_;
  std::optional<CSpaceKernels> kernels_;
  std::optional<MotionPrimitives> front_leading_;  ///< for goals ahead of the robot
  std::optional<MotionPrimitives> rear_leading_;   ///< for goals behind it
  bool is_goal_behind_ = false;
  std::optional<PlanGround> ground_;
};

}  // namespace adit
