// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

namespace adit {

/// Which local map is to be sent again next, to those who began later. Local maps go round: whoever
/// asks in between gets those that he missed on the next round, and several who ask at once get one
/// round.
class MapResender {
 public:
  /// All of so many local maps from now on, each once.
  void request(std::size_t maps) { left_ = maps; }

  /// The index of the next, of so many; nothing when the round is over.
  std::optional<std::size_t> next(std::size_t maps) {
    if (left_ == 0 || maps == 0) return std::nullopt;
    --left_;
    if (next_ >= maps) next_ = 0;
    return next_++;
  }

  [[nodiscard]] bool done() const { return left_ == 0; }

 private:
  std::size_t next_ = 0;
  std::size_t left_ = 0;  ///< in this round
};

}  // namespace adit
