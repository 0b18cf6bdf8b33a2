// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

namespace adit {

/// Schedules the local maps to resend to subscribers that started later. Local maps are sent in a
/// cycle: a request during a cycle restarts the count, so that its sender also gets the maps sent
/// before, and concurrent requests share one cycle.
class MapResender {
 public:
  /// Schedules all of `maps` local maps, each once.
  void request(std::size_t maps) { left_ = maps; }

  /// The index of the next of `maps` local maps; empty when the cycle is complete.
  std::optional<std::size_t> next(std::size_t maps) {
    if (left_ == 0 || maps == 0) return std::nullopt;
    --left_;
    if (next_ >= maps) next_ = 0;
    return next_++;
  }

  [[nodiscard]] bool done() const { return left_ == 0; }

 private:
  std::size_t next_ = 0;
  std::size_t left_ = 0;  ///< in this cycle
};

}  // namespace adit
