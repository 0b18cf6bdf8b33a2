// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace adit {

/// What a planner said who found no path, several times, from two poses.
struct BlockedVerdict {
  std::int64_t utime = 0;  ///< of the scan it rests on [µs since the epoch]
  std::int32_t stub = -1;  ///< that it was to go to; -1 on the way home
  double reached_m = 0.0;  ///< farthest progress that was possible
  std::string evidence;    ///< a sentence
  bool doubtful = false;   ///< what would be in the way was not seen, or not twice

  friend bool operator==(const BlockedVerdict&, const BlockedVerdict&) = default;
};

/// Where to go next? Repeated until it is answered; a verdict counts once for each id.
struct ExploreRequest {
  std::int64_t utime = 0;    ///< [µs since the epoch]
  std::int32_t id = 0;       ///< that the answer is to have, positive
  double remaining_m = 0.0;  ///< way that battery and time still allow
  bool homeward = false;     ///< nothing but the way home is asked for
  std::optional<BlockedVerdict> blocked;

  friend bool operator==(const ExploreRequest&, const ExploreRequest&) = default;
};

}  // namespace adit
