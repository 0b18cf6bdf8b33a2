// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace adit {

/// Two local maps of which one has walls where the other observed free space: one of them is at a
/// wrong pose relative to the other.
struct MapContradiction {
  int older_map = 0;  ///< id
  int newer_map = 0;
  double evidence = 0.0;  ///< −2 log-likelihood ratio: maps of one place against different places

  friend bool operator==(const MapContradiction&, const MapContradiction&) = default;
};

/// All of them at the poses of a pose graph.
struct MapContradictions {
  std::int64_t utime = 0;     ///< of the newest measurement used [µs since the epoch]
  std::int64_t revision = 0;  ///< of the pose graph
  std::vector<MapContradiction> pairs;

  friend bool operator==(const MapContradictions&, const MapContradictions&) = default;
};

}  // namespace adit
