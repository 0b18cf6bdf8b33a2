// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/pose_graph_pieces.hpp"

namespace adit {
namespace {

// On the wire.
constexpr std::size_t kHeadBytes = 64;
constexpr std::size_t kPoseBytes = 3 * sizeof(double);
constexpr std::size_t kConstraintBytes = 2 * sizeof(int) + 1 + 12 * sizeof(double);

}  // namespace

std::vector<PoseGraphPiece> divide(const MapGraph& graph) {
  PoseGraphPiece empty;
  empty.utime = graph.utime;
  empty.revision = graph.revision;
  empty.n_nodes = static_cast<int>(graph.poses.size());
  std::vector<PoseGraphPiece> pieces = {empty};
  std::size_t bytes = kHeadBytes;
  const auto place_for = [&](std::size_t more, std::size_t first_node) -> PoseGraphPiece& {
    if (bytes + more > kPieceBytes) {
      pieces.push_back(empty);
      pieces.back().first_node = static_cast<int>(first_node);
      bytes = kHeadBytes;
    }
    bytes += more;
    return pieces.back();
  };
  for (std::size_t i = 0; i < graph.poses.size(); ++i) {
    place_for(kPoseBytes, i).poses.push_back(graph.poses[i]);
  }
  for (const MapConstraint& constraint : graph.constraints) {
    place_for(kConstraintBytes, graph.poses.size()).constraints.push_back(constraint);
  }
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    pieces[i].n_pieces = static_cast<int>(pieces.size());
    pieces[i].piece = static_cast<int>(i);
  }
  return pieces;
}

bool same_head(const PoseGraphPiece& a, const PoseGraphPiece& b) { return a.n_nodes == b.n_nodes; }

std::size_t bytes_in_memory(const PoseGraphPiece& piece) {
  return sizeof(Pose2) * piece.poses.size() + sizeof(MapConstraint) * piece.constraints.size();
}

std::optional<MapGraph> join(const PieceSet<PoseGraphPiece>& pieces) {
  const PoseGraphPiece& head = *pieces.pieces().front();
  MapGraph graph{head.utime, head.revision, {}, {}};
  for (const auto& part : pieces.pieces()) {
    if (!part->poses.empty() && part->first_node != static_cast<int>(graph.poses.size())) return {};
    graph.poses.insert(graph.poses.end(), part->poses.begin(), part->poses.end());
    graph.constraints.insert(graph.constraints.end(), part->constraints.begin(),
                             part->constraints.end());
  }
  if (graph.poses.size() != static_cast<std::size_t>(head.n_nodes)) return std::nullopt;
  return graph;
}

}  // namespace adit
