// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "common/config/bounds.hpp"
#include "common/pose_graph/pose_graph.hpp"

namespace adit {

struct OptimizeParams {
  /// Whether to find a start from the measurements; else the poses of the graph are the start.
  bool rotation_initialization = true;
  double tolerance = 1e-9;   ///< done if a step promises less than this share of the objective
  int iterations_max = 500;  ///< a guard: iteration ends by itself

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
  kNotConverged,  ///< `iterations_max`, or no step lowers the objective
};

/// One line for a person.
std::string text(OptimizeReason reason, long node);

struct OptimizeResult {
  bool converged = false;
  OptimizeReason reason = OptimizeReason::kNotConverged;
  int node = -1;           ///< the culprit, if the reason has one
  int iterations = 0;      ///< steps taken
  int factorisations = 0;  ///< numeric, of the whole system, those of the start included
  double objective = 0.0;  ///< Σ eᵀ R e
};

/// What optimisation is at, for those who measure it: algorithms read no clock.
enum class OptimizePhase { kAnalysis, kStart, kFactorisation, kOther, kEnd };
using OptimizeObserver = std::function<void(OptimizePhase begins)>;

/// Moves the poses to the mode of the Gaussian Markov random field, the minimum of Σ eᵀ R e, by
/// iterated linearisation (paper, section 2.3; Lu and Milios 1997): Gauss-Newton, damped as by
/// Levenberg and Marquardt where the objective would rise. Pose 0 stays. One symbolic analysis; a
/// factor is used for as many steps as it is good for. Where the reason is neither kConverged nor
/// kNotConverged the poses are as they were.
OptimizeResult optimize(PoseGraph& graph, const OptimizeParams& params,
                        const OptimizeObserver& observer = {});

/// Poses by chaining the constraints i → i + 1 (or back) from pose 0, which stays: odometry. Of
/// several the first counts; a node without one stands where the node before it does.
void chain_odometry(PoseGraph& graph);

}  // namespace adit
