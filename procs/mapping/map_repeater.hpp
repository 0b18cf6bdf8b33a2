// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "common/local_map/local_map.hpp"
#include "common/messages/local_map_pieces.hpp"

namespace adit {

/// What is to be sent again to those who began later, a few pieces at a time. Local maps go round:
/// whoever asks in between gets those that he missed on the next round, and several who ask at
/// once get one round.
class MapRepeater {
 public:
  /// All of so many local maps from now on, each once.
  void ask(std::size_t maps) { left_ = maps; }

  /// The next pieces, `most` at most; none when the round is over.
  std::vector<LocalMapPiece> next(const std::vector<LocalMap>& maps, std::size_t most);

  [[nodiscard]] bool done() const { return left_ == 0 && pieces_.empty(); }

 private:
  std::size_t next_ = 0;  ///< index of a local map
  std::size_t left_ = 0;  ///< local maps in this round
  std::deque<LocalMapPiece> pieces_;
};

}  // namespace adit
