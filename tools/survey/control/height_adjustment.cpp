// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/control/height_adjustment.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <Eigen/LU>

#include "procs/mapping/mapping_node.hpp"

namespace adit {
namespace {

/// The height field of mapping, rebuilt.
MapHeights rebuilt_heights(const FullMap& map, const LogInfo& log_info) {
  std::vector<std::string> ignored;  // reported with the log
  MappingNodeParams params = recorded_params<MappingNodeParams>(log_info, "mapping", ignored);
  const LaserMounts mounts{{"LASER_FRONT", log_info.lasers.front},
                           {"LASER_REAR", log_info.lasers.rear}};
  std::vector<LocalMap> maps;
  WallStore walls;
  for (const LocalMap* local_map : map.local_maps) {
    maps.push_back(*local_map);
    walls.push_back(local_walls(*local_map, mounts, params.walls));
  }
  std::vector<PoseConstraint> loop_closures;
  for (const MapConstraint& constraint : map.graph.constraints) {
    const PoseConstraint& measured = constraint.measured;
    if (std::abs(measured.from - measured.to) > 1) loop_closures.push_back(measured);
  }
  MapHeights heights(params.heights);
  heights.update(maps, walls, loop_closures);
  return heights;
}

}  // namespace

Eigen::MatrixXd height_covariances(const FullMap& map, const SurveyGraph& free_network,
                                   const LogInfo& log_info,
                                   const std::vector<std::size_t>& observed) {
  const MapHeights heights = rebuilt_heights(map, log_info);
  const std::vector<SurveyGraph::Node>& nodes = free_network.nodes();
  const Eigen::VectorXd to_first = heights.variances_to(0);
  Eigen::MatrixXd covariances = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(nodes.size()),
                                                      static_cast<Eigen::Index>(observed.size()));
  for (std::size_t k = 0; k < observed.size(); ++k) {
    const SurveyGraph::Node& other = nodes[observed[k]];
    const Eigen::VectorXd to_other = heights.variances_to(other.id);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const double product = to_first[nodes[i].id] * to_first[other.id];
      if (product <= 0.0) continue;
      const double covariance =
          0.5 * (to_first[nodes[i].id] + to_first[other.id] - to_other[nodes[i].id]);
      covariances(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          covariance / std::sqrt(product) * std::sqrt(nodes[i].z_variance * other.z_variance);
    }
  }
  return covariances;
}

HeightSolution adjust_heights(const SurveyGraph& free_network,
                              const std::vector<HeightObservation>& observations,
                              const Eigen::MatrixXd& with_observed) {
  const auto count = static_cast<Eigen::Index>(free_network.nodes().size());
  Eigen::VectorXd z_m(count);
  Eigen::VectorXd variance(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const SurveyGraph::Node& node = free_network.nodes()[static_cast<std::size_t>(i)];
    z_m[i] = node.T_map_local.z_m;
    variance[i] = node.z_variance;
  }
  const auto n = static_cast<Eigen::Index>(observations.size());
  Eigen::VectorXd noise(n);
  Eigen::VectorXd y(n);
  Eigen::MatrixXd S(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const HeightObservation& observation = observations[static_cast<std::size_t>(i)];
    const auto node = static_cast<Eigen::Index>(observation.node);
    noise[i] = observation.variance;
    y[i] = observation.z_m - z_m[node];
    S.row(i) = with_observed.row(node);
  }
  S = 0.5 * (S + S.transpose()).eval();
  S.diagonal() += noise;
  const Eigen::MatrixXd S_inverse = S.inverse();
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(n);
  const double datum_variance = 1.0 / one.dot(S_inverse * one);
  const double datum_m = datum_variance * one.dot(S_inverse * y);
  const Eigen::VectorXd weight = S_inverse * (y - datum_m * one);

  HeightSolution solution;
  solution.z_m = z_m + with_observed * weight + Eigen::VectorXd::Constant(count, datum_m);
  const Eigen::MatrixXd gain = with_observed * S_inverse;
  const Eigen::VectorXd untied = Eigen::VectorXd::Ones(count) - gain * one;
  solution.variance = variance + datum_variance * untied.cwiseAbs2();
  solution.variance -= gain.cwiseProduct(with_observed).rowwise().sum();
  solution.variance = solution.variance.cwiseMax(0.0);
  solution.residual = -noise.cwiseProduct(weight);
  const Eigen::VectorXd tied = S_inverse * one;
  const Eigen::MatrixXd P = S_inverse - datum_variance * tied * tied.transpose();
  solution.test =
      n < 2 ? Eigen::VectorXd::Constant(n, std::numeric_limits<double>::quiet_NaN())
            : Eigen::VectorXd((P * y).cwiseAbs2().cwiseQuotient(P.diagonal().cwiseMax(1e-12)));
  return solution;
}

}  // namespace adit
