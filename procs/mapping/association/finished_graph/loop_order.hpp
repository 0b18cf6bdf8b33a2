// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "common/pose_graph/pose_graph.hpp"
#include "procs/mapping/association/association_problem.hpp"

namespace adit {

/// The order in which the loops of a finished graph are decided: most certain first. The less
/// uncertain the relative pose of two nodes is, the less likely is it that a wrong loop between
/// them passes for a right one; each accepted loop makes others more certain. How uncertain it is,
/// is estimated by the path of least variance between them along the odometry and the accepted
/// loops, between intervals of the odometry, not nodes, so that the cost is bounded.
class LoopOrder {
 public:
  /// `chain`: the odometry, from each node to the next. `bridges`: other certain constraints.
  /// `loops`: all loops, between these nodes.
  LoopOrder(const std::vector<PoseConstraint>& chain, const std::vector<PoseConstraint>& bridges,
            std::vector<PoseConstraint> loops);

  /// Pending loops, by their indices, most certain first.
  struct Candidates {
    std::vector<int> most_certain;  ///< the last is at most twice as uncertain as the first
    /// The next ones, where the former are few: both are a quarter of the accepted loops.
    std::vector<int> further;
  };
  /// The pending loops that are most certain where these loops are accepted, at most `most`.
  [[nodiscard]] Candidates most_certain(std::size_t most, const std::vector<int>& accepted) const;
  /// Takes loops from the pending ones.
  void take(const std::vector<int>& loops);
  [[nodiscard]] bool is_pending(int loop) const { return is_pending_[as_index(loop)]; }

 private:
  [[nodiscard]] double variance_of(const PoseConstraint& constraint) const;
  [[nodiscard]] int interval_of(int node) const { return interval_[as_index(node)]; }
  /// The intervals linked to each interval, with the least variance between them.
  using Links = std::vector<std::map<int, double>>;
  static void link(Links& links, int a, int b, double variance);
  [[nodiscard]] static std::vector<double> distances_from(const Links& links, int interval);

  std::vector<PoseConstraint> loops_;
  std::vector<bool> is_pending_;
  Eigen::Vector3d unit_ = Eigen::Vector3d::Ones();  // variances of a typical step of the odometry
  std::vector<int> interval_;                       // of each node
  double interval_variance_ = 0.0;
  Links chain_;
};

}  // namespace adit
