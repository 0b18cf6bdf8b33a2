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

/// A part of the poses and constraints of a MapGraph, on channel POSE_GRAPH.
struct PoseGraphFragment {
  static constexpr int kNodesMax = 1'000'000;   ///< nodes of a graph
  static constexpr int kFragmentsMax = 10'000;  ///< fragments of a graph

  std::int64_t utime = 0;
  std::int64_t revision = 0;
  int n_nodes = 0;  ///< of the complete graph
  int n_fragments = 1;
  int fragment = 0;                        ///< 0 to n_fragments − 1
  int first_node = 0;                      ///< node of the first pose here
  std::vector<Pose2> poses;                ///< T_map_local of consecutive nodes
  std::vector<double> z_m;                 ///< their heights above node 0 [m],
  std::vector<double> z_variance;          ///< and the variances of these [m²]
  std::vector<MapConstraint> constraints;  ///< between any nodes of the graph
};

/// Lossless: from_message restores the same bits.
pose_graph_t to_message(const PoseGraphFragment& fragment);

/// Rejects an implausible time, a negative revision, an implausible number of nodes or fragments,
/// an index out of range, a fragment that is too large, poses of nodes outside the graph,
/// constraints of an unknown kind, of nodes outside the graph or of a node with itself, poses that
/// are not finite, invalid information matrices.
Result<PoseGraphFragment> from_message(const pose_graph_t& message);

/// Splits a graph deterministically into fragments of up to kFragmentBytes: poses first, then
/// constraints.
std::vector<PoseGraphFragment> split(const MapGraph& graph);

inline int reassembly_id(const PoseGraphFragment& /*fragment*/) { return 0; }
inline auto recency(const PoseGraphFragment& fragment) {
  return std::pair(fragment.utime, fragment.revision);
}
bool same_header(const PoseGraphFragment& a, const PoseGraphFragment& b);
std::size_t bytes_in_memory(const PoseGraphFragment& fragment);
/// Poses and constraints in order; nothing if a pose is missing or duplicated.
std::optional<MapGraph> reassemble(const FragmentSet<PoseGraphFragment>& fragments);

/// Holds the newest graph only.
using PoseGraphReassembler = Reassembler<PoseGraphFragment, ReassemblyLimits{.bytes = 256'000'000}>;

map_correction_t to_message(const MapCorrection& correction);

/// Rejects an implausible time, a negative revision, session or id, a pose that is not finite, an
/// invalid covariance matrix.
Result<MapCorrection> from_message(const map_correction_t& message);

map_request_t to_message(const MapRequest& request);

/// Rejects an implausible time and an empty stage.
Result<MapRequest> from_message(const map_request_t& message);

}  // namespace adit
