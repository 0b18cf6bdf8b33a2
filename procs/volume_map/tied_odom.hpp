// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>

#include "common/geometry/pose2.hpp"

namespace adit {

/// An odom frame by the newest local map that was made in it.
struct TiedOdom {
  static constexpr std::int64_t kNoEnd = std::numeric_limits<std::int64_t>::max();

  std::int64_t begin_utime = 0;  ///< 0: not known [µs since the epoch]
  std::int64_t end_utime = kNoEnd;
  int session = 0;
  int local_map = 0;  ///< id
  Pose2 T_local_odom;

  /// Whether what was taken then was taken in it.
  [[nodiscard]] bool has(std::int64_t utime) const {
    return begin_utime <= utime && utime < end_utime;
  }

  friend bool operator==(const TiedOdom&, const TiedOdom&) = default;
};

}  // namespace adit
