// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/level_pose.hpp"
#include "sim/world/world.hpp"
#include "tools/eval/trajectory.hpp"
#include "tools/survey/mine_survey.hpp"

namespace adit {

/// The true mesh of a simulated mine, seen from the frame of its survey.
class SurveyTruth {
 public:
  /// The mine of the recorded CONFIG of the simulator. Throws std::runtime_error if the log has
  /// none, or no TRUTH. `survey` must outlive this. `T_grid_world`: of a survey with control;
  /// without it survey and world are compared at the start of the mission.
  explicit SurveyTruth(const MineSurvey& survey, const std::optional<LevelPose>& T_grid_world = {});

  [[nodiscard]] const World& world() const { return site_.world(); }
  [[nodiscard]] const RayScene& scene() const { return site_.scene(); }
  [[nodiscard]] const LevelPose& T_world_survey() const { return T_world_survey_; }
  /// T_world_survey by the true pose of a local map: what is measured from there is placed without
  /// the error of the graph. Nothing without TRUTH at its time.
  [[nodiscard]] std::optional<LevelPose> T_world_survey_at(std::size_t node) const;

  /// The true outline of a section: its rays cast from the same point.
  [[nodiscard]] SectionOutline outline(const CrossSection& section, const LevelPose& T_world) const;
  /// The true height of a surface above (`up`) or below a point in world; nothing without one.
  [[nodiscard]] std::optional<double> surface_z_m(const Eigen::Vector3d& p_world, bool up) const;

 private:
  const MineSurvey& survey_;
  Site site_;
  LevelPose T_world_survey_;
};

}  // namespace adit
