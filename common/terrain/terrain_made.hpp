// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace adit {

/// A 3D scan has become a terrain map, and all of that was sent.
struct TerrainMade {
  std::int64_t utime = 0;  ///< TerrainMap::utime [µs since the epoch]
  std::int32_t id = 0;     ///< Cloud::id
  bool complete = true;    ///< Cloud::complete

  friend bool operator==(const TerrainMade&, const TerrainMade&) = default;
};

}  // namespace adit
