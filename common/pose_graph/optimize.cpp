// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/pose_graph/optimize.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "common/pose_graph/normal_equations.hpp"
#include "common/pose_graph/rotation_initialization.hpp"

namespace adit {
namespace {

// Ratio of successive predicted decreases below which a factor is reused, and iterated
// linearisation converges well.
constexpr double kContraction = 0.2;
constexpr double kCurvatureShareMin = 0.1;  // less is not tried
constexpr double kLambdaFirst = 1e-4;       // initial damping, if needed
constexpr double kLambdaMax = 1e8;
constexpr double kLambdaMin = 1e-7;  // less is set to zero

/// A step, and the predicted decrease of the objective by the linearisation.
struct Step {
  Eigen::VectorXd delta;
  double predicted_decrease = 0.0;
};

class Optimizer {
 public:
  Optimizer(PoseGraph& graph, const OptimizeParams& params, const OptimizeObserver& observer)
      : graph_(graph), params_(params), observer_(observer) {}

  OptimizeResult run() {
    begin_phase(OptimizePhase::kAnalysis);
    const GraphStructure structure = analyse(graph_);
    NormalEquations equations(structure);
    begin_phase(OptimizePhase::kStart);
    if (params_.rotation_initialization) {
      ++result_.factorisations;
      if (!initialize_from_rotations(graph_, structure, equations)) return undetermined(equations);
    }
    begin_phase(OptimizePhase::kOther);
    result_.objective = equations.linearise(graph_);
    while (result_.iterations < params_.iterations_max) {
      while (!factorise(equations)) {
        if (curvature_share_ == 0.0) return undetermined(equations);
        reduce_curvature();
        linearise(equations);
      }
      if (!descend(equations)) break;
      linearise(equations);
    }
    return result_;
  }

 private:
  void begin_phase(OptimizePhase phase) const {
    if (observer_) observer_(phase);
  }

  void linearise(NormalEquations& equations) const {
    if (curvature_share_ > 0.0) {
      equations.linearise_with_curvature(graph_, curvature_share_);
    } else {
      equations.linearise(graph_);
    }
  }

  /// With all of its curvature the matrix is not positive definite here.
  void reduce_curvature() {
    curvature_share_ *= 0.5;
    if (curvature_share_ < kCurvatureShareMin) curvature_share_ = 0.0;
  }

  bool factorise(NormalEquations& equations) {
    begin_phase(OptimizePhase::kFactorisation);
    ++result_.factorisations;
    if (lambda_ > 0.0) equations.matrix().damp(lambda_);
    const bool factorised = equations.matrix().factorise();
    begin_phase(OptimizePhase::kOther);
    return factorised;
  }

  /// Takes steps with the present factor, while each predicts much less than the one before. False:
  /// the optimisation is finished.
  bool descend(NormalEquations& equations) {
    for (bool first = true; result_.iterations < params_.iterations_max; first = false) {
      const Step step = solve(equations);
      const bool done = step.predicted_decrease <= params_.negligible_decrease(result_.objective);
      const bool slow = step.predicted_decrease > kContraction * predicted_decrease_;
      predicted_decrease_ = step.predicted_decrease;
      if (slow && !first && !done) return true;
      if (first) update_curvature(slow);
      const bool damped = lambda_ > 0.0;
      if (!try_step(step, equations)) {
        if (done) return finish();  // the remainder is rounding
        if (!first) return true;
        lambda_ = std::max(kLambdaFirst, 10.0 * lambda_);
        return lambda_ <= kLambdaMax;
      }
      if (first) lambda_ = lambda_ > kLambdaMin ? 0.1 * lambda_ : 0.0;
      if (done) return damped || finish();
    }
    return false;
  }

  /// Includes the curvature after a step by a fresh factor that hardly contracted, as much of it as
  /// may be positive definite.
  void update_curvature(bool slow) {
    if (!includes_curvature_ && !slow) return;
    curvature_share_ = includes_curvature_
                           ? std::clamp(2.0 * curvature_share_, 2.0 * kCurvatureShareMin, 1.0)
                           : 1.0;
    includes_curvature_ = true;
  }

  static Step solve(const NormalEquations& equations) {
    Step step{equations.matrix().solve(equations.b()), 0.0};
    step.predicted_decrease = step.delta.dot(equations.b());
    return step;
  }

  /// False, with the poses unchanged, if the objective would rise.
  bool try_step(const Step& step, NormalEquations& equations) {
    std::vector<Pose2> before = graph_.poses;
    move_poses(step.delta, graph_.poses);
    const double objective = equations.linearise_gradient(graph_);
    if (!(objective <= result_.objective)) {
      graph_.poses = std::move(before);
      return false;
    }
    result_.objective = objective;
    ++result_.iterations;
    return true;
  }

  bool finish() {
    result_.converged = true;
    result_.reason = OptimizeReason::kConverged;
    return false;
  }

  OptimizeResult undetermined(const NormalEquations& equations) {
    result_.reason = OptimizeReason::kUndetermined;
    result_.node = equations.matrix().weakest_block() + 1;
    return result_;
  }

  PoseGraph& graph_;
  const OptimizeParams& params_;
  const OptimizeObserver& observer_;
  OptimizeResult result_;
  double lambda_ = 0.0;
  double predicted_decrease_ = std::numeric_limits<double>::infinity();  // of the last step
  /// Of the curvature of the residuals in the matrix: none (Gauss-Newton) until steps no longer
  /// contract, as with large residuals; all of it (Newton) where that is positive definite.
  double curvature_share_ = 0.0;
  bool includes_curvature_ = false;
};

}  // namespace

std::string text(OptimizeReason reason, long node) {
  switch (reason) {
    case OptimizeReason::kConverged:
      return "converged";
    case OptimizeReason::kEmpty:
      return "the graph has no poses";
    case OptimizeReason::kUnconnected:
      return fmt::format("no chain of constraints links pose {} with the first", node);
    case OptimizeReason::kUndetermined:
      return fmt::format("the constraints leave pose {} free to move", node);
    case OptimizeReason::kNotConverged:
      return "not converged";
  }
  return {};
}

OptimizeResult optimize(PoseGraph& graph, const OptimizeParams& params,
                        const OptimizeObserver& observer) {
  OptimizeResult result;
  if (graph.poses.empty()) {
    result.reason = OptimizeReason::kEmpty;
  } else if (const auto node = first_unconnected_node(graph)) {
    result.reason = OptimizeReason::kUnconnected;
    result.node = *node;
  } else if (graph.poses.size() == 1) {
    result.converged = true;
    result.reason = OptimizeReason::kConverged;
  } else {
    const std::vector<Pose2> before = graph.poses;
    result = Optimizer(graph, params, observer).run();
    if (result.reason == OptimizeReason::kUndetermined) graph.poses = before;
  }
  if (observer) observer(OptimizePhase::kEnd);
  return result;
}

void chain_odometry(PoseGraph& graph) {
  std::vector<const PoseConstraint*> step(graph.poses.size(), nullptr);
  for (const PoseConstraint& c : graph.constraints) {
    if (std::abs(c.to - c.from) != 1) continue;
    const PoseConstraint*& slot = step[static_cast<std::size_t>(std::max(c.from, c.to))];
    if (slot == nullptr) slot = &c;
  }
  for (std::size_t i = 1; i < graph.poses.size(); ++i) {
    graph.poses[i] = graph.poses[i - 1];
    if (step[i] == nullptr) continue;
    const Pose2& T_from_to = step[i]->T_from_to;
    const bool forward = step[i]->from < step[i]->to;
    graph.poses[i] = graph.poses[i - 1] * (forward ? T_from_to : T_from_to.inverse());
  }
}

}  // namespace adit
