// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/pose_graph/g2o_file.hpp"
#include "common/pose_graph/optimize.hpp"
#include "procs/mapping/association/lazy_association.hpp"

namespace adit {

/// Wall time that an optimisation spends in each of its phases. Give `observer()` to `optimize`.
class PhaseStopwatch {
 public:
  PhaseStopwatch() : since_(Clock::now()) {}

  [[nodiscard]] OptimizeObserver observer() {
    return [this](OptimizePhase begins) { enter(begins); };
  }
  /// What comes before the first phase counts as kOther, what comes after kEnd as nothing.
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

/// What lazy data association made of the loops of a file.
struct LoopDecisions {
  using Ids = std::pair<long, long>;  ///< of the poses that a loop links, as in the file

  std::vector<Ids> accepted;
  std::vector<Ids> rejected;
  int trials = 0;     ///< beliefs that were worked out
  int revisions = 0;  ///< decisions that were changed later
  double association_ms = 0.0;
};

struct OptimizeRun {
  OptimizeResult result;
  PhaseStopwatch stopwatch;
  std::optional<LoopDecisions> loops;  ///< nothing: all were believed
};

/// Moves the poses of a file to where they agree best with all constraints. Throws
/// std::runtime_error, with the pose by its id, where the constraints do not say where poses are.
OptimizeRun optimize_all(G2oGraph& file);

/// Decides first which loops to believe (see associate_loops_lazily) and leaves the others out of
/// the file. Throws also where the way from pose to pose has a gap. `progress` gets the share of
/// the association that is done.
OptimizeRun optimize_lazily(G2oGraph& file, const LazyAssociationParams& params,
                            const std::function<void(double)>& progress = {});

/// The figures of an optimisation as JSON: size of the graph, objective, iterations,
/// factorisations, whether it converged, what was decided about loops, and the wall time of the
/// phases in milliseconds. A loop is a pair of ids on one line.
std::string to_json(const PoseGraph& graph, const OptimizeRun& run);

}  // namespace adit
