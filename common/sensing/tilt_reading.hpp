// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace adit {

/// How far a tilting laser is pitched against its level mount; positive looks down.
struct TiltReading {
  std::int64_t utime = 0;  ///< time of measurement [µs since the epoch]
  double angle_rad = 0.0;
  double rate_rad_s = 0.0;

  friend bool operator==(const TiltReading&, const TiltReading&) = default;
};

}  // namespace adit
