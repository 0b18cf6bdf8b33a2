// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/frame/survey_graph.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/pose_graph/gaussian_field.hpp"

namespace adit {

namespace {

/// Of a pose (x, y, θ) along the axes of a local map; along those of survey.
Eigen::Matrix3d in_survey(const Eigen::Matrix3d& covariance, double theta_survey_local) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(theta_survey_local).toRotationMatrix();
  return R * covariance * R.transpose();
}

void add_step(const GaussianField& field, const SurveyGraph::Node& before,
              SurveyGraph::Node& node) {
  node.step_covariance =
      in_survey(field.relative_covariance(before.id, node.id), before.T_survey_local.plan.theta);
  // Heights are known from the start on: what is added is that of the step.
  node.step_z_variance = std::abs(node.z_variance - before.z_variance);
}

}  // namespace

SurveyGraph SurveyGraph::free_network(const FullMap& map) {
  const MapGraph& graph = map.graph;
  const GaussianField field(pose_graph_of(graph));
  std::vector<Node> nodes;
  for (const LocalMap* local_map : map.local_maps) {
    if (local_map->utime == 0) continue;  // missing in the log
    const auto id = static_cast<std::size_t>(local_map->id);
    Node node;
    node.id = local_map->id;
    node.session = local_map->session;
    node.T_map_local = {graph.poses[id], id < graph.z_m.size() ? graph.z_m[id] : 0.0};
    node.T_survey_local = node.T_map_local;
    node.T_odom_local = {local_map->T_odom_local, local_map->z_odom_m};
    node.utime = local_map->utime;
    if (id < graph.z_variance.size()) node.z_variance = graph.z_variance[id];
    if (id > 0)
      node.covariance =
          in_survey(field.relative_covariance(0, local_map->id), graph.poses[0].theta);
    if (!nodes.empty()) add_step(field, nodes.back(), node);
    nodes.push_back(node);
  }
  if (nodes.empty())
    throw std::runtime_error("none of the local maps of the pose graph is in the log");
  return SurveyGraph(std::move(nodes));
}

std::size_t SurveyGraph::node_at(std::int64_t utime) const {
  const auto after =
      std::upper_bound(nodes_.begin(), nodes_.end(), utime,
                       [](std::int64_t time, const Node& node) { return time < node.utime; });
  return after == nodes_.begin() ? 0 : static_cast<std::size_t>(after - nodes_.begin()) - 1;
}

std::size_t SurveyGraph::node_near(const Eigen::Vector2d& p_map) const {
  const auto distance = [&](const Node& node) {
    return (node.T_map_local.plan.translation() - p_map).squaredNorm();
  };
  const auto nearest = std::ranges::min_element(nodes_, {}, distance);
  return static_cast<std::size_t>(nearest - nodes_.begin());
}

std::size_t SurveyGraph::node_near_in_survey(const Eigen::Vector2d& p_survey) const {
  const auto distance = [&](const Node& node) {
    return (node.T_survey_local.plan.translation() - p_survey).squaredNorm();
  };
  const auto nearest = std::ranges::min_element(nodes_, {}, distance);
  return static_cast<std::size_t>(nearest - nodes_.begin());
}

LevelPose SurveyGraph::T_survey_map(std::size_t node) const {
  const Node& at = nodes_[node];
  return at.T_survey_local * at.T_map_local.inverse();
}

Eigen::Matrix3d SurveyGraph::covariance_at(std::size_t node,
                                           const Eigen::Vector3d& p_survey) const {
  const Node& at = nodes_[node];
  const Eigen::Vector2d lever = p_survey.head<2>() - at.T_survey_local.plan.translation();
  Eigen::Matrix<double, 2, 3> J = Eigen::Matrix<double, 2, 3>::Identity();
  J(0, 2) = -lever.y();
  J(1, 2) = lever.x();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  covariance.topLeftCorner<2, 2>() = J * at.covariance * J.transpose();
  covariance(2, 2) = at.z_variance;
  return covariance;
}

Eigen::Matrix3d SurveyGraph::covariance_between(std::size_t from, std::size_t to) const {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = from + 1; i <= to; ++i) {
    const Eigen::Vector2d step = nodes_[i].T_survey_local.plan.translation() -
                                 nodes_[i - 1].T_survey_local.plan.translation();
    Eigen::Matrix3d J = Eigen::Matrix3d::Identity();
    J(0, 2) = -step.y();
    J(1, 2) = step.x();
    covariance = J * covariance * J.transpose() + nodes_[i].step_covariance;
  }
  return covariance;
}

double SurveyGraph::z_variance_between(std::size_t from, std::size_t to) const {
  double variance = 0.0;
  for (std::size_t i = from + 1; i <= to; ++i) variance += nodes_[i].step_z_variance;
  return variance;
}

}  // namespace adit
