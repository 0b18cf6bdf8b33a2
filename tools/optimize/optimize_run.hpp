// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/pose_graph/certified_optimum.hpp"
#include "common/pose_graph/g2o_file.hpp"
#include "common/pose_graph/optimize.hpp"
#include "procs/mapping/association/lazy_association.hpp"

namespace adit {

/// Wall time of the phases of an optimisation. Pass `observer()` to `optimize`.
class PhaseStopwatch {
 public:
  PhaseStopwatch() : since_(Clock::now()) {}

  [[nodiscard]] OptimizeObserver observer() {
    return [this](OptimizePhase begins) { enter(begins); };
  }
  /// Time before the first phase counts as kOther; time after kEnd is not counted.
  [[nodiscard]] double ms(OptimizePhase phase) const { return ms_[index(phase)]; }
  [[nodiscard]] double total_ms() const;

 private:
  using Clock = std::chrono::steady_clock;
  static std::size_t index(OptimizePhase phase) { return static_cast<std::size_t>(phase); }
  void enter(OptimizePhase begins);

  std::array<double, 5> ms_{};
  OptimizePhase phase_ = OptimizePhase::kOther;
  Clock::time_point since_;
};

/// Decisions of lazy data association on the loop closures of a file.
struct LoopDecisions {
  using Ids = std::pair<long, long>;  ///< of the two poses of a loop closure, as in the file

  std::vector<Ids> accepted;
  std::vector<Ids> rejected;
  /// Constraints that bridge the gaps of the odometry, one for each, and were not doubted.
  std::vector<Ids> bridges;
  /// Why accepted loop closures may be wrong or the poses not the best, one sentence each.
  std::vector<std::string> doubts;
  int trials = 0;     ///< evaluated hypotheses
  int revisions = 0;  ///< decisions that were revised later
  double association_ms = 0.0;
};

/// A run that was added to the optimum of a graph.
struct AddedRun {
  std::string file;
  std::size_t poses = 0;
  std::size_t constraints = 0;
  OptimizeResult result;  ///< of the graph with the run
  double wall_ms = 0.0;   ///< without reading the file
};

struct OptimizeRun {
  OptimizeResult result;
  PhaseStopwatch stopwatch;
  std::optional<LoopDecisions> loops;  ///< nothing if all are accepted without association
  std::optional<Certificate> certificate;
  double certify_ms = 0.0;
  std::vector<AddedRun> added;
};

/// Finds the poses of a file that minimise the objective over all constraints. With `certify`, or
/// where a residual is implausible (has_implausible_residual), the minimum is certified, which may
/// lead to a better one. Throws std::runtime_error, with the id of a pose, if the constraints do
/// not determine the poses.
OptimizeRun optimize_all(G2oGraph& file, bool certify = false);

/// Finds the poses that minimise the objective of a file, then those with the poses and constraints
/// of each run (read_g2o_run) as well, in order, by the factor of the graph before
/// (GrowingOptimum). Throws as `optimize_all`, for runs with the name of their file.
OptimizeRun optimize_with_runs(G2oGraph& file, const std::vector<std::filesystem::path>& runs,
                               const std::function<void(double)>& progress = {});

/// Removes the loop closures that lazy data association rejects (associate_loops_lazily), then
/// optimises the rest. Gaps in the odometry, the constraints between consecutive poses, are bridged
/// by other constraints (GraphOdometry). `progress` gets the finished share of the association.
OptimizeRun optimize_lazily(G2oGraph& file, const LazyAssociationParams& params,
                            const std::function<void(double)>& progress = {});

/// Figures of an optimisation as JSON: size of the graph, convergence, objective, iterations,
/// factorisations, decisions on loop closures, and the wall time of the phases in milliseconds. A
/// loop closure is a pair of ids on one line.
std::string to_json(const PoseGraph& graph, const OptimizeRun& run);

}  // namespace adit
