// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "common/pose_graph/pose_graph.hpp"

namespace adit::test {

enum class LoopLabel { kNone, kRight, kWrong, kUnknown };  ///< kNone: not a loop

/// A pose graph with ground truth: a label for each loop closure and true poses of some nodes.
struct LabelledGraph {
  PoseGraph graph;
  std::vector<LoopLabel> labels;  ///< of each constraint
  std::vector<int> true_nodes;    ///< nodes with a true pose, ascending
  std::vector<Pose2> truth;       ///< their true poses, in an arbitrary frame
};

/// Reads `NAME.g2o`, `NAME.labels` (lines `from to ok|wrong|unknown …`) and the ground truth (lines
/// `id x y theta`), plain or gzip; `#` starts a comment line. Throws std::runtime_error if a file
/// cannot be read or a label has no loop closure in the graph.
LabelledGraph read_labelled_graph(const std::filesystem::path& g2o,
                                  const std::filesystem::path& ground_truth);

/// Number of accepted loop closures with a label.
int count_accepted(const LabelledGraph& graph, const std::vector<bool>& accepted, LoopLabel label);

/// RMSE of the node positions after rigid alignment with the ground truth [m].
double rmse_m(const LabelledGraph& graph, const std::vector<Pose2>& poses);

}  // namespace adit::test
