// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/messages/pieces.hpp"
#include "common/messages/pose_graph.hpp"
#include "common/pose_graph/map_graph.hpp"

namespace adit {

/// Divides a graph, always in the same way, into pieces of up to kPieceBytes: poses first, then
/// constraints.
std::vector<PoseGraphPiece> divide(const MapGraph& graph);

/// Joins the pieces of a graph, in whatever order they come. It waits for the newest graph only,
/// that is the one with the latest time, and of these the one of the highest revision. What it
/// holds is bounded: one graph, of as many bytes as the limit says.
class PoseGraphAssembler {
 public:
  static constexpr std::size_t kBytesMax = 256'000'000;

  /// Since the start. All but `joined` is lost, to this receiver.
  struct Counts {
    std::int64_t joined = 0;         ///< graphs given back
    std::int64_t duplicates = 0;     ///< pieces that were there already
    std::int64_t contradictory = 0;  ///< pieces that do not go with those before them
    std::int64_t outdated = 0;       ///< pieces of an older graph
    std::int64_t superseded = 0;     ///< incomplete graphs for which a newer one came
    std::int64_t given_up = 0;       ///< graphs that took too much room, or lack poses

    friend bool operator==(const Counts&, const Counts&) = default;
  };

  explicit PoseGraphAssembler(std::size_t bytes_max = kBytesMax) : bytes_max_(bytes_max) {}

  /// The graph that this piece completes, or nothing.
  std::optional<MapGraph> add(const PoseGraphPiece& piece);

  [[nodiscard]] const Counts& counts() const { return counts_; }

 private:
  struct Waiting {
    PoseGraphPiece head;  // without poses and constraints
    PieceSet<PoseGraphPiece> parts;
    std::size_t bytes = 0;
  };

  bool make_place_for(const PoseGraphPiece& piece);
  std::optional<MapGraph> join();

  std::size_t bytes_max_;
  Counts counts_;
  std::optional<Waiting> waiting_;
};

}  // namespace adit
