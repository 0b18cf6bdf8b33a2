// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "common/geometry/pose2.hpp"

namespace adit {

/// What is known of the rock around one place, and where that place is in map. The frame "volume"
/// is the frame level of the first 3D scan in it: its z is 0 on the ground where that was taken. As
/// map is a plane, ground that rises from one sub-volume to the next is a step between them.
struct Volume {
  std::int64_t utime = 0;  ///< of the newest 3D scan in it [µs since the epoch]
  std::int32_t id = 0;     ///< 0, 1, ... in the order of the way
  /// How many 3D scans came into it, and how often it forgot them.
  std::int32_t revision = 1;
  std::int64_t graph_revision = 0;  ///< of the MapGraph from which the pose follows
  std::int32_t local_map = 0;       ///< id of that with which it moves
  Pose2 T_map_volume;
  double cell_m = 0.0;
  std::int64_t occupied = 0;         ///< cells
  std::int64_t free = 0;             ///< cells
  std::vector<std::uint8_t> octree;  ///< see octree_stream.hpp
};

}  // namespace adit
