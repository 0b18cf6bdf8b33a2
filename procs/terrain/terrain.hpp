// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/types/cloud.hpp"
#include "common/types/terrain_map.hpp"
#include "procs/terrain/memory/terrain_memory.hpp"
#include "procs/terrain/terrain_params.hpp"

namespace adit {

/// Makes 2½D terrain maps directly from the points of 3D scans (paper, section 3.1), in the frame
/// level of the cloud; the vehicle stands on the ground at the origin. Beyond the paper: stray
/// points are ignored, obstacles over unobserved ground are not ground, and unknown ground is
/// classified.
class Terrain {
 public:
  explicit Terrain(const TerrainParams& params) : params_(params) {}

  /// Skips points that are not usable (`unusable_points`). A cloud without points gives an unknown
  /// map.
  [[nodiscard]] TerrainMap make(const Cloud& cloud) const;
  /// The same, filled in from earlier scans; adds the scan to the memory.
  [[nodiscard]] TerrainMap make(const Cloud& cloud, TerrainMemory& memory) const;

 private:
  [[nodiscard]] TerrainMap blank(const Cloud& cloud) const;
  [[nodiscard]] TerrainMap heights(const Cloud& cloud) const;
  void derive_layers(TerrainMap& map) const;

  TerrainParams params_;
};

}  // namespace adit
