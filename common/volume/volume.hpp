// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "common/geometry/pose2.hpp"
#include "common/volume/voxel_grid.hpp"

namespace adit {

/// Cells that follow each other along the curve and are all of one kind.
struct CellRun {
  VoxelCode first = 0;
  VoxelCode end = 0;  ///< behind the last
  bool occupied = false;

  friend bool operator==(const CellRun&, const CellRun&) = default;
};

/// What is free and occupied, in OctoMap's binary form: what follows behind "data" in a .bt file
/// (Hornung et al. 2013, section 3.5). Each node that has children takes two bytes, two bits for
/// each child (01 free, 10 occupied, 11 has children itself, 00 unknown), then come the children
/// that have children. No bytes: nothing is known.
inline constexpr std::size_t kOctreeBytesMax = 4'000'000;

/// Gives the leaves along the curve. Returns nothing, or why it refused: damaged in a way that
/// shows, or longer than kOctreeBytesMax; then leaves may have been given before. OctoMap's own
/// reader takes damaged bytes for a tree, and more where the bytes end.
std::string_view visit_leaves(std::span<const std::uint8_t> octree,
                              const std::function<void(const CellRun&)>& visit);

struct OctreeCounts {
  std::int64_t occupied = 0;
  std::int64_t free = 0;
  std::string_view rejection;  ///< why there are none, if so
};

/// Counts the cells.
OctreeCounts count_cells(std::span<const std::uint8_t> octree);

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
