// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "common/pose_graph/normal_equations.hpp"
#include "common/pose_graph/optimize.hpp"
#include "common/pose_graph/pose_graph.hpp"

namespace adit {

/// The optimum of a large graph to which runs are added: that of all constraints again after each,
/// without a factorisation of the complete system.
///
/// With H of the graph before, whose factor is kept, C of the poses of the run and B between both,
/// the step of the poses before solves (H + E K Eᵀ) δ = b. E selects the poses that the run links
/// to, K = D − Bᵀ C⁻¹ B is what it adds there. Conjugate gradients preconditioned by H have
/// residuals that are zero but in these poses, so that an iteration solves only along their paths
/// to the root of the elimination tree. K ⪰ 0: all eigenvalues are at least 1, and those above 1
/// are as many as the run measures better than the graph did.
class GrowingOptimum {
 public:
  /// Optimises the graph; `result` says with what success.
  explicit GrowingOptimum(PoseGraph graph, const OptimizeParams& params = {},
                          const OptimizeObserver& observer = {});
  ~GrowingOptimum();
  GrowingOptimum(GrowingOptimum&&) noexcept;
  GrowingOptimum& operator=(GrowingOptimum&&) noexcept;

  /// Adds `poses` poses, whose indices continue those of the graph, with all their constraints, and
  /// constraints between poses of the graph. Where steps with the kept factor converge slowly, or
  /// the runs have grown to a tenth of the graph, the complete graph is optimised and the factor
  /// renewed: `factorisations` is then not 0. Nothing is added if the result is neither kConverged
  /// nor kNotConverged.
  OptimizeResult add(int poses, const std::vector<PoseConstraint>& constraints,
                     const OptimizeObserver& observer = {});

  [[nodiscard]] const PoseGraph& graph() const { return graph_; }
  /// Of the first optimisation.
  [[nodiscard]] const OptimizeResult& result() const { return first_; }

 private:
  void keep_factor();
  void start_from_map(std::size_t poses_before, std::size_t constraints_before);
  [[nodiscard]] bool descend(OptimizeResult& result);

  PoseGraph graph_;
  OptimizeParams params_;
  OptimizeResult first_;
  std::unique_ptr<NormalEquations> kept_;  ///< of the first poses and constraints; its factor
  std::vector<Pose2> kept_poses_;          ///< where it is linearised
  std::size_t kept_constraints_ = 0;
};

}  // namespace adit
