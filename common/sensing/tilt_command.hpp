// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace adit {

/// Where a tilting laser is to go, and how fast. It stays there.
struct TiltCommand {
  std::int64_t utime = 0;   ///< time of the command [µs since the epoch]
  double angle_rad = 0.0;   ///< as in TiltReading: positive looks down
  double rate_rad_s = 0.0;  ///< greatest rate on the way, positive

  friend bool operator==(const TiltCommand&, const TiltCommand&) = default;
};

}  // namespace adit
