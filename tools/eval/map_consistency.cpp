// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/eval/map_consistency.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/Cholesky>

#include "common/pose_graph/gaussian_field.hpp"

namespace adit {
namespace {

// 95 % of a normal distribution, and of chi-square with three degrees of freedom.
constexpr double kSigmas = 1.959964;
constexpr double kChiSquare = 7.814728;

std::optional<GaussianField> field_of(const MapGraph& graph) try {
  return GaussianField(pose_graph_of(graph));
} catch (const std::runtime_error&) {  // not connected
  return std::nullopt;
}

/// Plan and height are estimated apart.
Eigen::Matrix3d position_covariance(const Eigen::Matrix3d& plan, double z_variance) {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  covariance.topLeftCorner<2, 2>() = plan.topLeftCorner<2, 2>();
  covariance(2, 2) = z_variance;
  return covariance;
}

void add(const Eigen::Vector3d& error, const Eigen::Matrix3d& covariance,
         MapConsistency& consistency) {
  ++consistency.local_maps;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    const double sd = std::sqrt(covariance(axis, axis));
    consistency.in_interval[i] += std::abs(error[axis]) <= kSigmas * sd ? 1U : 0U;
  }
  const double normalised = error.dot(covariance.ldlt().solve(error));
  consistency.in_ellipsoid += normalised <= kChiSquare ? 1U : 0U;
  consistency.normalised_error_squared += normalised;
}

}  // namespace

std::optional<MapConsistency> score_consistency(const MapGraph& graph,
                                                const std::map<int, std::int64_t>& utimes,
                                                const Trajectory& truth) {
  const std::size_t nodes = graph.poses.size();
  if (nodes < 2 || graph.z_m.size() != nodes || graph.z_variance.size() != nodes) return {};
  const auto first = utimes.find(0);
  if (first == utimes.end()) return {};
  // The robot rests in its first scans: the truth may begin a little later.
  constexpr std::int64_t kRestUs = 1'000'000;
  if (truth.empty() || truth.front().utime > first->second + kRestUs) return {};
  const auto start = interpolate_in_space(truth, std::max(first->second, truth.front().utime));
  const auto field = field_of(graph);
  if (!start || !field) return {};

  MapConsistency consistency;
  for (const auto& [id, utime] : utimes) {
    const auto node = static_cast<std::size_t>(id);
    const auto true_at = interpolate_in_space(truth, utime);
    if (id <= 0 || node >= nodes || !true_at) continue;
    const Pose2 estimated = between(graph.poses[0], graph.poses[node]);
    const Pose2 real = between(start->pose, true_at->pose);
    const double z_error_m = (graph.z_m[node] - graph.z_m[0]) - (true_at->z_m - start->z_m);
    add({estimated.x - real.x, estimated.y - real.y, z_error_m},
        position_covariance(field->relative_covariance(0, id), graph.z_variance[node]),
        consistency);
  }
  if (consistency.local_maps == 0) return {};
  consistency.normalised_error_squared /= static_cast<double>(consistency.local_maps);
  return consistency;
}

}  // namespace adit
