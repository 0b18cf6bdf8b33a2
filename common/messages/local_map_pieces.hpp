// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "common/local_map/local_map.hpp"
#include "common/messages/local_map.hpp"
#include "common/messages/pieces.hpp"

namespace adit {

/// Divides a local map, always in the same way: each piece but the last takes as many scans as fit
/// kPieceBytes; a scan that is larger alone has a piece to itself.
std::vector<LocalMapPiece> divide(const LocalMap& map);

/// Joins the pieces of local maps, in whatever order they come. Of an id it waits for the newest
/// only, that is the one with the latest end. What it holds is bounded: where too much is
/// incomplete, the local map whose last piece came longest ago is given up.
class LocalMapAssembler {
 public:
  struct Limits {
    std::size_t incomplete = 8;      ///< local maps
    std::size_t bytes = 64'000'000;  ///< of the scans in all pieces that are held
  };

  /// Since the start. All but `joined` is lost, to this receiver.
  struct Counts {
    std::int64_t joined = 0;         ///< local maps given back
    std::int64_t duplicates = 0;     ///< pieces that were there already
    std::int64_t contradictory = 0;  ///< pieces with another head than those before them
    std::int64_t outdated = 0;       ///< pieces of an older revision
    std::int64_t superseded = 0;     ///< incomplete local maps for which a newer revision came
    std::int64_t given_up = 0;       ///< incomplete local maps that took too much room

    friend bool operator==(const Counts&, const Counts&) = default;
  };

  LocalMapAssembler() : LocalMapAssembler(Limits{}) {}
  explicit LocalMapAssembler(const Limits& limits) : limits_(limits) {}

  /// The local map that this piece completes, or nothing.
  std::optional<LocalMap> add(const LocalMapPiece& piece);

  [[nodiscard]] const Counts& counts() const { return counts_; }
  /// Local maps that wait for pieces.
  [[nodiscard]] std::size_t incomplete() const { return waiting_.size(); }

 private:
  struct Waiting {
    LocalMap head;  // without scans
    PieceSet<std::vector<LocalScan>> scans;
    std::size_t bytes = 0;     // of the scans
    std::int64_t touched = 0;  // number of the last piece
  };

  Waiting* place_for(const LocalMapPiece& piece);
  LocalMap take(int id);
  void keep_within_limits();
  void erase(std::map<int, Waiting>::iterator waiting);

  Limits limits_;
  Counts counts_;
  std::map<int, Waiting> waiting_;  // by id
  std::size_t bytes_ = 0;
  std::int64_t pieces_seen_ = 0;
};

}  // namespace adit
