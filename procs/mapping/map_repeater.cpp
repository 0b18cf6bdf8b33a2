// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/map_repeater.hpp"

#include <utility>

namespace adit {

std::vector<LocalMapPiece> MapRepeater::next(const std::vector<LocalMap>& maps, std::size_t most) {
  std::vector<LocalMapPiece> pieces;
  while (pieces.size() < most && !done()) {
    if (pieces_.empty()) {
      if (next_ >= maps.size()) next_ = 0;
      for (LocalMapPiece& piece : divide(maps[next_])) pieces_.push_back(std::move(piece));
      ++next_;
      --left_;
    }
    pieces.push_back(std::move(pieces_.front()));
    pieces_.pop_front();
  }
  return pieces;
}

}  // namespace adit
