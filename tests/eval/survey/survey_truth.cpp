// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/eval/survey/survey_truth.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "common/bus/node/recorded_section.hpp"
#include "sim/world/build_world.hpp"

namespace adit {
namespace {

constexpr float kReachM = 30.0F;

World world_of(const LogInfo& log_info) {
  std::vector<std::string> warnings;
  for (const auto& [stage, config] : log_info.configs) {
    if (const auto world = recorded_section<WorldDescription>(config, "world", warnings))
      return build_world(*world);
  }
  throw std::runtime_error("no simulated mine in the log");
}

LevelPose level_pose(const TimedPose& pose) { return {pose.pose, pose.z_m}; }

}  // namespace

SurveyTruth::SurveyTruth(const MineSurvey& survey, const std::optional<LevelPose>& T_grid_world)
    : survey_(survey), site_(world_of(survey.input().log_info())) {
  if (survey.input().truth().empty()) throw std::runtime_error("no TRUTH in the log");
  if (T_grid_world) {
    const Eigen::Vector3d& origin = survey.frame().origin();
    const LevelPose T_grid_survey{{origin.x(), origin.y(), 0.0}, origin.z()};
    T_world_survey_ = between(*T_grid_world, T_grid_survey);
    return;
  }
  // The robot rests in its first scans.
  T_world_survey_ = level_pose(survey.input().truth().front()) *
                    survey.graph().nodes().front().T_survey_local.inverse();
}

std::optional<LevelPose> SurveyTruth::T_world_survey_at(std::size_t node) const {
  const SurveyGraph::Node& at = survey_.graph().nodes()[node];
  const Trajectory& truth = survey_.input().truth();
  const auto pose = interpolate_in_space(truth, std::max(at.utime, truth.front().utime));
  if (!pose) return std::nullopt;
  return level_pose(*pose) * at.T_survey_local.inverse();
}

SectionOutline SurveyTruth::outline(const CrossSection& section, const LevelPose& T_world) const {
  const SectionPlane& plane = section.plane;
  const Eigen::Vector3d inside(plane.p_survey.x(), plane.p_survey.y(), section.z_middle_m);
  const Eigen::Vector3d from = T_world * inside;
  SectionOutline outline;
  for (std::size_t i = 0; i < SectionOutline::kRays; ++i) {
    const Eigen::Vector2d direction = SectionOutline::direction(i);
    const Eigen::Vector2d in_plan = direction.x() * plane.left();
    const Eigen::Vector3d to =
        T_world * (inside + Eigen::Vector3d(in_plan.x(), in_plan.y(), direction.y()));
    const Ray ray{from.cast<float>(), (to - from).normalized().cast<float>()};
    if (const auto hit = site_.scene().cast(ray, kReachM, RayScene::Layer::kSolid))
      outline.rays[i] = {hit->distance_m, 0.0};
  }
  return outline;
}

std::optional<double> SurveyTruth::surface_z_m(const Eigen::Vector3d& p_world, bool up) const {
  const Ray ray{p_world.cast<float>(), {0.0F, 0.0F, up ? 1.0F : -1.0F}};
  const auto hit = site_.scene().cast(ray, kReachM, RayScene::Layer::kSolid);
  if (!hit) return std::nullopt;
  return p_world.z() + (up ? 1.0 : -1.0) * static_cast<double>(hit->distance_m);
}

}  // namespace adit
