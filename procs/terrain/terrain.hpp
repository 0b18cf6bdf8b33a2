// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/types/cloud.hpp"
#include "common/types/terrain_map.hpp"
#include "procs/terrain/memory/terrain_memory.hpp"
#include "procs/terrain/terrain_params.hpp"

namespace adit {

/// Makes 2½D terrain maps straight from the points of 3D scans (the paper's section 3.1), in the
/// frame level of the cloud. The vehicle stands on the ground at the origin. Beyond the paper:
/// stray points are ignored, what hangs over ground that is not seen is no ground, and unknown
/// ground is told apart.
class Terrain {
 public:
  explicit Terrain(const TerrainParams& params) : params_(params) {}

  /// Points that are not usable (`unusable_points`) are passed over. A cloud without points gives a
  /// map of which nothing is known.
  [[nodiscard]] TerrainMap make(const Cloud& cloud) const;
  /// The same with what earlier clouds showed and this one does not, which it goes into itself.
  [[nodiscard]] TerrainMap make(const Cloud& cloud, TerrainMemory& memory) const;

 private:
  [[nodiscard]] TerrainMap blank(const Cloud& cloud) const;
  [[nodiscard]] TerrainMap heights(const Cloud& cloud) const;
  void derive_layers(TerrainMap& map) const;

  TerrainParams params_;
};

}  // namespace adit
