// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "common/types/cloud.hpp"
#include "common/types/terrain_map.hpp"
#include "procs/terrain/cell_heights.hpp"
#include "procs/terrain/ground_level.hpp"
#include "procs/terrain/terrain_params.hpp"
#include "procs/terrain/visibility/beams.hpp"

namespace adit {

/// What beams say of a place where none of them ended.
struct GroundEvidence {
  Ground ground = Ground::kNeverObserved;
  /// kObserved: of the ground between two beams that met it. kBelowRay: of the lowest beam over the
  /// place (the virtual surface of arXiv 2010.16018). NaN for the others. z in level [m].
  float height_m = std::numeric_limits<float>::quiet_NaN();
};

/// The beams of one laser that looked around from one place, as a fan of upright half-planes, and
/// in each of these the lowest beam at every distance. Costs one visit for each beam, and not one
/// for each cell on its way: from one place a steeper beam is lower all the way, so that the lowest
/// at a distance is the steepest of those that reach it.
class SightLines {
 public:
  /// Lines begin close together, within the lever of a tilting mount.
  SightLines(std::span<const CloudLine* const> lines, const BeamEnds& ends, const TerrainMap& map,
             const TerrainParams& params);

  [[nodiscard]] const GroundEvidence& at(float x, float y) const;

 private:
  /// Two beams of which none between them met anything.
  struct Gap {
    BeamEnd below;
    BeamEnd above;
    float foot_m = 0.0F;  ///< z of the ground shortly before the end of the one below
  };

  void classify_sector(std::span<BeamEnd> beams, std::span<GroundEvidence> out) const;
  [[nodiscard]] GroundEvidence between(const Gap& gap, float range_m) const;
  [[nodiscard]] float spacing_m(const Gap& gap) const;
  [[nodiscard]] bool passes_over(const Gap& gap) const;
  [[nodiscard]] bool is_behind_crest(const Gap& gap) const;

  UnseenGroundParams params_;
  float bridged_m_;
  float cell_m_;
  Eigen::Vector3f origin_{0.0F, 0.0F, 0.0F};
  std::size_t bins_;                          ///< of distance, a cell each
  std::vector<GroundEvidence> observations_;  ///< by sector, in each by distance
};

/// Says of the cells that no point shows why not, from the beams that went there, and gives those
/// between beams that met the ground its height. Where lasers looked from several places, the one
/// that knows most is believed.
void classify_unseen_ground(TerrainMap& map, const Cloud& cloud, const CellHeights& heights,
                            const GroundLevel& ground, const TerrainParams& params);

}  // namespace adit
