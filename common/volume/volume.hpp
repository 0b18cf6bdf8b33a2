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

/// A run of consecutive cells along the Morton curve in the same state.
struct CellRun {
  VoxelCode first = 0;
  VoxelCode end = 0;  ///< one past the last
  bool occupied = false;

  friend bool operator==(const CellRun&, const CellRun&) = default;
};

/// Largest accepted octree [bytes]. An octree holds free and occupied space in OctoMap's binary
/// form: the bytes after "data" in a .bt file (Hornung et al. 2013, section 3.5). Each inner node
/// takes two bytes, two bits per child (01 free, 10 occupied, 11 inner node, 00 unknown), followed
/// by its children that are inner nodes. Zero bytes: everything is unknown.
inline constexpr std::size_t kOctreeBytesMax = 4'000'000;

/// Visits the leaves in the order of the Morton curve. Returns an empty string, or the reason for
/// which the octree is rejected: detectably damaged, or longer than kOctreeBytesMax; some
/// leaves may have been visited before. OctoMap's own reader accepts damaged bytes as a tree and
/// reads past their end.
std::string_view visit_leaves(std::span<const std::uint8_t> octree,
                              const std::function<void(const CellRun&)>& visit);

struct OctreeCounts {
  std::int64_t occupied = 0;
  std::int64_t free = 0;
  std::string_view rejection;  ///< reason why the octree was rejected, otherwise empty
};

/// Counts the cells of each state.
OctreeCounts count_cells(std::span<const std::uint8_t> octree);

/// A sub-volume: the free and occupied space around one place, and the pose of that place in map.
/// The frame "volume" is the level frame of the first 3D scan in it: its z is 0 on the ground where
/// that scan was taken.
struct Volume {
  std::int64_t utime = 0;  ///< of the newest 3D scan in it [µs since the epoch]
  std::int32_t id = 0;     ///< 0, 1, ... in the order of the traversed path
  /// Counts the 3D scans inserted and the resets.
  std::int32_t revision = 1;
  std::int64_t graph_revision = 0;  ///< of the MapGraph that determines the pose
  std::int32_t local_map = 0;       ///< id of the local map to which the volume is anchored
  Pose2 T_map_volume;
  double cell_m = 0.0;
  std::int64_t occupied = 0;         ///< cells
  std::int64_t free = 0;             ///< cells
  std::vector<std::uint8_t> octree;  ///< see visit_leaves()
  double z_map_m = 0.0;              ///< height of volume in map
};

}  // namespace adit
