// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "adit/pose_graph_t.hpp"

#include "common/messages/result.hpp"
#include "common/pose_graph/map_graph.hpp"

namespace adit {

/// Some of the poses and constraints of a MapGraph, as they go onto channel POSE_GRAPH; see
/// pose_graph_pieces.hpp.
struct PoseGraphPiece {
  static constexpr int kNodesMax = 1'000'000;  ///< of the whole graph
  static constexpr int kPiecesMax = 10'000;    ///< of it

  std::int64_t utime = 0;
  std::int64_t revision = 0;
  int n_nodes = 0;  ///< of the whole graph
  int n_pieces = 1;
  int piece = 0;                           ///< 0 to n_pieces − 1
  int first_node = 0;                      ///< whose pose comes first here
  std::vector<Pose2> poses;                ///< T_map_local of consecutive nodes
  std::vector<MapConstraint> constraints;  ///< between any nodes of the whole graph
};

/// Comes back with the same bits.
pose_graph_t to_message(const PoseGraphPiece& piece);

/// Refused: an implausible time, a negative revision, more nodes or pieces than plausible, a piece
/// that is not one of them, more bytes than a piece may have, poses of nodes that are not in the
/// graph, and constraints of an unknown kind, of such nodes or of a node with itself; poses that
/// are not finite, information matrices that are none.
Result<PoseGraphPiece> from_message(const pose_graph_t& message);

}  // namespace adit
