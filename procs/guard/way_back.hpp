// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

namespace adit {

/// Lets the vehicle go back where it came from: what it drove into (bad air, soft ground, a slope)
/// forbids to go on, not to leave. Directions are 1 forward, -1 in reverse, 0 to stand.
class WayBack {
 public:
  /// Something that ended this long ago is over. Before, it may only have wavered at its limit
  /// while the vehicle was leaving, and the way back is still the same.
  static constexpr std::int64_t kOverAfterUs = 10'000'000;

  /// Whether a command in this direction is forbidden, by what is there or not at this time (by
  /// SteadyTime, not before the last).
  bool forbids(bool is_there, int direction, std::int64_t now_us);

 private:
  int driven_ = 0;             ///< direction of the last drive before it was there
  std::optional<int> into_;    ///< direction in which it was driven into
  std::int64_t there_us_ = 0;  ///< when it was there last
};

}  // namespace adit
