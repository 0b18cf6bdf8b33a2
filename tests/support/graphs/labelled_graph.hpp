// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "common/pose_graph/pose_graph.hpp"

namespace adit::test {

enum class LoopLabel { kNone, kRight, kWrong, kUnknown };  ///< kNone: not a loop

/// A pose graph of which is known which of its loops are right, and where the robot truly was.
struct LabelledGraph {
  PoseGraph graph;
  std::vector<LoopLabel> labels;  ///< of each constraint
  std::vector<int> true_nodes;    ///< of which the true pose is known, in ascending order
  std::vector<Pose2> truth;       ///< theirs, in a frame of its own
};

/// From `NAME.g2o`, `NAME.labels` (lines `from to ok|wrong|unknown …`) and lines `id x y theta`,
/// plain or gzip; `#` starts a comment line. Throws std::runtime_error where a file cannot be read
/// or a label is for a loop that is not there.
LabelledGraph read_labelled_graph(const std::filesystem::path& g2o,
                                  const std::filesystem::path& ground_truth);

/// How many loops of a label are believed.
int count_accepted(const LabelledGraph& graph, const std::vector<bool>& accepted, LoopLabel label);

/// How far the nodes are from the truth, after rigid alignment [m].
double rmse_m(const LabelledGraph& graph, const std::vector<Pose2>& poses);

}  // namespace adit::test
