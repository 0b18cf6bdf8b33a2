// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "adit/map_correction_t.hpp"
#include "adit/map_request_t.hpp"
#include "adit/pose_graph_t.hpp"

#include "common/messages/fragments.hpp"
#include "common/messages/result.hpp"
#include "common/pose_graph/map_correction.hpp"
#include "common/pose_graph/map_graph.hpp"
#include "common/types/map_request.hpp"

namespace adit {

/// Some of the poses and constraints of a MapGraph, as they go onto channel POSE_GRAPH; see
/// pose_graph_pieces.hpp.
struct PoseGraphFragment {
  static constexpr int kNodesMax = 1'000'000;   ///< of the whole graph
  static constexpr int kFragmentsMax = 10'000;  ///< of it

  std::int64_t utime = 0;
  std::int64_t revision = 0;
  int n_nodes = 0;  ///< of the whole graph
  int n_fragments = 1;
  int fragment = 0;                        ///< 0 to n_fragments − 1
  int first_node = 0;                      ///< whose pose comes first here
  std::vector<Pose2> poses;                ///< T_map_local of consecutive nodes
  std::vector<MapConstraint> constraints;  ///< between any nodes of the whole graph
};

/// Comes back with the same bits.
pose_graph_t to_message(const PoseGraphFragment& fragment);

/// Refused: an implausible time, a negative revision, more nodes or pieces than plausible, a piece
/// that is not one of them, more bytes than a piece may have, poses of nodes that are not in the
/// graph, and constraints of an unknown kind, of such nodes or of a node with itself; poses that
/// are not finite, information matrices that are none.
Result<PoseGraphFragment> from_message(const pose_graph_t& message);

/// Divides a graph, always in the same way, into pieces of up to kFragmentBytes: poses first, then
/// constraints.
std::vector<PoseGraphFragment> split(const MapGraph& graph);

inline auto recency(const PoseGraphFragment& fragment) {
  return std::pair(fragment.utime, fragment.revision);
}
bool same_header(const PoseGraphFragment& a, const PoseGraphFragment& b);
std::size_t bytes_in_memory(const PoseGraphFragment& fragment);
/// Everything in order again; nothing where a pose is missing or given twice.
std::optional<MapGraph> reassemble(const FragmentSet<PoseGraphFragment>& fragments);

using PoseGraphReassembler = LatestReassembler<PoseGraphFragment, 256'000'000>;

map_correction_t to_message(const MapCorrection& correction);

/// Refused: an implausible time, a negative revision, session or id, a pose that is not finite, a
/// covariance matrix that is none.
Result<MapCorrection> from_message(const map_correction_t& message);

map_request_t to_message(const MapRequest& request);

/// Refused: an implausible time, no name.
Result<MapRequest> from_message(const map_request_t& message);

}  // namespace adit
