// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace adit {

/// When a stage is to ask mapping for the map: at its start, and again where nothing of it came for
/// a while and something is lacking.
class MapAsker {
 public:
  static constexpr std::int64_t kAgainUs = 5'000'000;

  /// Something of the map came, or it was asked for.
  void heard(std::int64_t utime) { last_utime_ = utime; }

  /// Whether to ask now [µs since the epoch].
  [[nodiscard]] bool is_due(std::int64_t utime, bool lacking) const {
    return lacking && (last_utime_ == 0 || utime - last_utime_ >= kAgainUs);
  }

 private:
  std::int64_t last_utime_ = 0;
};

}  // namespace adit
