// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/frame/registered_cloud.hpp"

#include "tools/survey/frame/level_correction.hpp"

namespace adit {

RegisteredCloud::RegisteredCloud(const CloudStore& clouds, const SurveyGraph& graph)
    : clouds_(clouds), graph_(graph) {
  std::vector<LeveledScan> leveled;
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    const Cloud& cloud = clouds[i];
    const std::size_t node = graph.node_at(cloud.utime);
    const SurveyGraph::Node& at = graph.nodes()[node];
    const LevelPose T_local_level =
        between(at.T_odom_local, LevelPose{cloud.T_odom_level, cloud.z_odom_m});
    scans_.push_back(
        {cloud.utime, static_cast<int>(i) + 1, node, at.T_survey_local * T_local_level});
    leveled.push_back({i, at.session, scans_.back().T_survey_level});
    points_ += clouds.points(i);
  }
  const LevelCorrection level(clouds, leveled);
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    scans_[i].correction = level.rotation(leveled[i].session);
    scans_[i].level_sd_rad = level.sd_rad(leveled[i].session);
  }
}

/// A rotation of the level frame about a horizontal axis lifts a point by its distance in plan, and
/// shifts it in plan by its height above the frame.
Eigen::Matrix3d RegisteredCloud::scan_covariance(const SurveyPoint& point) const {
  const Eigen::Vector3d lever = point.p_survey - point.scan->T_survey_level.translation();
  const double level_variance = point.scan->level_sd_rad * point.scan->level_sd_rad;
  const double plan = level_variance * lever.z() * lever.z();
  const double height = level_variance * lever.head<2>().squaredNorm();
  const double range = kRangeSdM * kRangeSdM;
  return Eigen::Vector3d(plan + range, plan + range, height + range).asDiagonal();
}

Eigen::Matrix3d RegisteredCloud::covariance(const SurveyPoint& point) const {
  return graph_.covariance_at(point.scan->node, point.p_survey) + scan_covariance(point);
}

}  // namespace adit
