// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "common/messages/newest_assembler.hpp"
#include "common/messages/pose_graph.hpp"
#include "common/pose_graph/map_graph.hpp"

namespace adit {

/// Divides a graph, always in the same way, into pieces of up to kPieceBytes: poses first, then
/// constraints.
std::vector<PoseGraphPiece> divide(const MapGraph& graph);

inline auto age(const PoseGraphPiece& piece) { return std::pair(piece.utime, piece.revision); }
bool same_head(const PoseGraphPiece& a, const PoseGraphPiece& b);
std::size_t bytes_in_memory(const PoseGraphPiece& piece);
/// Everything in order again; nothing where a pose is missing or given twice.
std::optional<MapGraph> join(const PieceSet<PoseGraphPiece>& pieces);

using PoseGraphAssembler = NewestAssembler<PoseGraphPiece, 256'000'000>;

}  // namespace adit
