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
#include "procs/terrain/visibility/passing_beams.hpp"

namespace adit {

/// Evidence of the beams for a place where none of them ended.
struct GroundEvidence {
  Ground ground = Ground::kNeverObserved;
  /// kObserved: height of the ground between two beams that hit it. kBelowRay: height of the lowest
  /// beam over the place (the virtual surface of arXiv 2010.16018). NaN otherwise. z in level [m].
  float height_m = std::numeric_limits<float>::quiet_NaN();
};

/// Lines of sight of a laser at one viewpoint, as a fan of vertical half-planes, with the lowest
/// beam at each distance in each of them. The cost is one visit per beam, not one per cell along
/// it: from one viewpoint a steeper beam is lower everywhere, so that the lowest beam at a distance
/// is the steepest of those that reach it.
class SightLines {
 public:
  /// All lines must begin close together, within the lever arm of a tilting mount.
  SightLines(std::span<const CloudLine* const> lines, const BeamEnds& ends, const TerrainMap& map,
             const TerrainParams& params);

  [[nodiscard]] const GroundEvidence& at(float x, float y) const;

 private:
  /// Two consecutive beams of a sector, ordered by slope.
  struct Gap {
    BeamEnd below;
    BeamEnd above;
    float foot_m = 0.0F;  ///< z of the ground shortly before the end of `below`, along the trend
  };

  void classify_sector(std::span<BeamEnd> beams, std::span<GroundEvidence> out) const;
  [[nodiscard]] GroundEvidence between(const Gap& gap, float range_m) const;
  /// Height of the laser above a plane through the end of the lower beam with the trend of the
  /// ground [m].
  [[nodiscard]] float laser_height_m(const Gap& gap) const;
  [[nodiscard]] float spacing_m(const Gap& gap) const;
  [[nodiscard]] bool passes_over(const Gap& gap) const;
  [[nodiscard]] bool is_bridged(const Gap& gap) const;
  [[nodiscard]] bool is_behind_crest(const Gap& gap) const;

  UnseenGroundParams params_;
  float bridged_m_;
  float cell_m_;
  Eigen::Vector3f origin_;
  std::size_t bins_;                          ///< number of distance bins, one cell each
  std::vector<GroundEvidence> observations_;  ///< by sector, then distance
};

/// Classifies the cells without points from the beams that were aimed at them, and interpolates the
/// height of cells between beams that hit the ground. With scans from several viewpoints the
/// strongest evidence counts.
void classify_unseen_ground(TerrainMap& map, const Cloud& cloud, const CellHeights& heights,
                            const GroundLevel& ground, const PassingBeams& beams,
                            const TerrainParams& params);

}  // namespace adit
