// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "common/pose_graph/g2o_file.hpp"
#include "common/pose_graph/optimize.hpp"
#include "procs/mapping/association/lazy_association.hpp"
#include "tools/optimize/phase_stopwatch.hpp"

namespace adit {

/// What lazy data association made of the loops of a file.
struct LoopVerdicts {
  using Ids = std::pair<long, long>;  ///< of the poses that a loop links, as in the file

  std::vector<Ids> kept;
  std::vector<Ids> rejected;
  int trials = 0;     ///< beliefs that were worked out
  int revisions = 0;  ///< decisions that were changed later
  double association_ms = 0.0;
};

struct OptimizeRun {
  OptimizeResult result;
  PhaseStopwatch stopwatch;
  std::optional<LoopVerdicts> loops;  ///< nothing: all were believed
};

/// Moves the poses of a file to where they agree best with all constraints. Throws
/// std::runtime_error, with the pose by its id, where the constraints do not say where poses are.
OptimizeRun optimize_all(G2oGraph& file);

/// Decides first which loops to believe (see believe_lazily) and leaves the others out of the file.
/// Throws also where the way from pose to pose has a gap. `progress` gets the share of the
/// association that is done.
OptimizeRun optimize_lazily(G2oGraph& file, const LazyAssociationParams& params,
                            const std::function<void(double)>& progress = {});

}  // namespace adit
