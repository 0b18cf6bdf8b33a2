// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/pose_graph_pieces.hpp"

#include <algorithm>
#include <compare>
#include <utility>

namespace adit {
namespace {

// On the wire.
constexpr std::size_t kHeadBytes = 64;
constexpr std::size_t kPoseBytes = 3 * sizeof(double);
constexpr std::size_t kConstraintBytes = 2 * sizeof(int) + 1 + 12 * sizeof(double);

std::size_t bytes_in_memory(const PoseGraphPiece& piece) {
  return sizeof(Pose2) * piece.poses.size() + sizeof(MapConstraint) * piece.constraints.size();
}

auto age(const PoseGraphPiece& piece) { return std::pair(piece.utime, piece.revision); }

/// Everything in order again; nothing where a pose is missing or given twice.
std::optional<MapGraph> join_parts(const PieceSet<PoseGraphPiece>& parts) {
  const PoseGraphPiece& head = *parts.pieces().front();
  MapGraph graph{head.utime, head.revision, {}, {}};
  for (const auto& part : parts.pieces()) {
    if (!part->poses.empty() && part->first_node != static_cast<int>(graph.poses.size())) return {};
    graph.poses.insert(graph.poses.end(), part->poses.begin(), part->poses.end());
    graph.constraints.insert(graph.constraints.end(), part->constraints.begin(),
                             part->constraints.end());
  }
  if (graph.poses.size() != static_cast<std::size_t>(head.n_nodes)) return std::nullopt;
  return graph;
}

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

std::optional<MapGraph> PoseGraphAssembler::add(const PoseGraphPiece& piece) {
  if (!make_place_for(piece)) return std::nullopt;
  if (!waiting_->parts.add(piece.piece, piece)) {
    ++counts_.duplicates;
    return std::nullopt;
  }
  waiting_->bytes += bytes_in_memory(piece);
  if (waiting_->parts.complete()) return join();
  if (waiting_->bytes > bytes_max_) {
    ++counts_.given_up;
    waiting_.reset();
  }
  return std::nullopt;
}

/// Whether the piece belongs to the graph that is now waited for.
bool PoseGraphAssembler::make_place_for(const PoseGraphPiece& piece) {
  if (waiting_) {
    if (age(piece) < age(waiting_->head)) {
      ++counts_.outdated;
      return false;
    }
    if (age(piece) == age(waiting_->head)) {
      const bool same =
          piece.n_nodes == waiting_->head.n_nodes && piece.n_pieces == waiting_->head.n_pieces;
      if (!same) ++counts_.contradictory;
      return same;
    }
    ++counts_.superseded;
  }
  PoseGraphPiece head = piece;
  head.poses.clear();
  head.constraints.clear();
  waiting_ = Waiting{std::move(head), PieceSet<PoseGraphPiece>(piece.n_pieces)};
  return true;
}

std::optional<MapGraph> PoseGraphAssembler::join() {
  std::optional<MapGraph> graph = join_parts(waiting_->parts);
  graph ? ++counts_.joined : ++counts_.given_up;
  waiting_.reset();
  return graph;
}

}  // namespace adit
