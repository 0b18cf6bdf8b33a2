// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "common/config/bounds.hpp"
#include "common/pose_graph/pose_graph.hpp"

namespace adit {

struct OptimizeParams {
  /// Whether to initialise from the measurements; otherwise from the poses of the graph.
  bool rotation_initialization = true;
  /// Converged if a step predicts a smaller relative decrease of the objective.
  double tolerance = 1e-9;
  int iterations_max = 500;  ///< safety limit

  /// Predicted decrease of an objective below which it is at its minimum.
  [[nodiscard]] double negligible_decrease(double objective) const {
    return tolerance * objective + 1e-9;  // of a chi-square
  }

  template <class V>
  void visit(V& v) {
    v("rotation_initialization", rotation_initialization);
    v("tolerance", tolerance, within(1e-15, 1e-2));
    v("iterations_max", iterations_max, within(1, 100000));
  }
};

enum class OptimizeReason {
  kConverged,
  kEmpty,         ///< no pose
  kUnconnected,   ///< no chain of constraints links `node` with node 0
  kUndetermined,  ///< the information leaves `node` free to move
  kNotConverged,  ///< `iterations_max` reached, or no step lowers the objective
};

/// The reason as a sentence for display.
std::string text(OptimizeReason reason, long node);

struct OptimizeResult {
  bool converged = false;
  OptimizeReason reason = OptimizeReason::kNotConverged;
  int node = -1;       ///< the node concerned, if the reason has one
  int iterations = 0;  ///< steps taken
  /// Numeric factorisations of the complete system, initialisation included.
  int factorisations = 0;
  double objective = 0.0;  ///< Σ eᵀ R e
};

/// The phases of optimisation, for an observer that measures time: algorithms read no clock.
enum class OptimizePhase { kAnalysis, kStart, kFactorisation, kOther, kEnd };
using OptimizeObserver = std::function<void(OptimizePhase begins)>;

/// Moves the poses to the mode of the Gaussian Markov random field, the minimum of Σ eᵀ R e, by
/// iterated linearisation (paper, section 2.3; Lu and Milios 1997): Gauss-Newton, or Newton where
/// that contracts slowly, damped as by Levenberg and Marquardt where the objective would rise. Pose
/// 0 is fixed. One symbolic analysis; a factor is reused for several steps while it converges. The
/// poses change only if the reason is kConverged or kNotConverged.
OptimizeResult optimize(PoseGraph& graph, const OptimizeParams& params,
                        const OptimizeObserver& observer = {});

/// Sets the poses by chaining the constraints i → i + 1 (or back) from pose 0, which is fixed:
/// odometry. The first of several counts; a node without one gets the pose of the node before.
void chain_odometry(PoseGraph& graph);

}  // namespace adit
