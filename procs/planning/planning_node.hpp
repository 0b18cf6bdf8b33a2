// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "common/bus/bus.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/mapping/terrain.hpp"
#include "procs/planning/goals/known_clearance.hpp"
#include "procs/planning/planning.hpp"

namespace adit {

/// In:  TERRAIN (terrain_t), in fragments; GOAL (plan_goal_t); POSE (pose_t);
///      MAP_CORRECTION (map_correction_t), for the clearance along the traversed path.
/// Out: PATH (planned_path_t), once for each goal, over the newest terrain. A goal that arrives
///      before the first terrain or pose is pending until then; a newer goal replaces it.
class PlanningNode {
 public:
  using Params = PlanningParams;

  /// Throws as Planning does.
  PlanningNode(Bus& bus, const Params& params);

  /// Degraded while a goal is pending, and if the last terrain could not be planned on.
  [[nodiscard]] Health health() const;

 private:
  void try_plan();
  [[nodiscard]] PlannedPath plan();
  [[nodiscard]] PlannedPath retraced() const;

  Bus& bus_;
  Planning planning_;
  TerrainReassembler assembler_;
  std::optional<TerrainMap> terrain_;
  std::optional<Pose2> T_odom_body_;
  KnownClearance clearance_;
  std::optional<PlanGoal> goal_;  ///< pending
  std::string failure_;           ///< error of the last plan; empty without one
};

}  // namespace adit
