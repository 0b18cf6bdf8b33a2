// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/frame/registered_cloud.hpp"

namespace adit {

RegisteredCloud::RegisteredCloud(const std::vector<Cloud>& clouds, const SurveyGraph& graph,
                                 const ScanAccuracy& accuracy)
    : graph_(graph), accuracy_(accuracy) {
  for (const Cloud& cloud : clouds) {
    const std::size_t node = graph.node_at(cloud.utime);
    const SurveyGraph::Node& at = graph.nodes()[node];
    const LevelPose T_local_level =
        between(at.T_odom_local, LevelPose{cloud.T_odom_level, cloud.z_odom_m});
    scans_.push_back(
        {&cloud, static_cast<int>(scans_.size()) + 1, node, at.T_survey_local * T_local_level});
    points_ += cloud.points();
  }
}

/// A rotation of the level frame about a horizontal axis lifts a point by its distance in plan, and
/// shifts it in plan by its height above the frame.
Eigen::Matrix3d RegisteredCloud::scan_covariance(const SurveyPoint& point) const {
  const Eigen::Vector3d lever = point.p_survey - point.scan->T_survey_level.translation();
  const double level_variance = accuracy_.level_sd_rad * accuracy_.level_sd_rad;
  const double plan = level_variance * lever.z() * lever.z();
  const double height = level_variance * lever.head<2>().squaredNorm();
  const double range = accuracy_.range_sd_m * accuracy_.range_sd_m;
  return Eigen::Vector3d(plan + range, plan + range, height + range).asDiagonal();
}

Eigen::Matrix3d RegisteredCloud::covariance(const SurveyPoint& point) const {
  return graph_.covariance_at(point.scan->node, point.p_survey) + scan_covariance(point);
}

}  // namespace adit
