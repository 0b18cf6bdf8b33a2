// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/types/cloud.hpp"
#include "procs/terrain/cell_heights.hpp"
#include "procs/terrain/ground_level.hpp"
#include "procs/terrain/visibility/passing_beams.hpp"

namespace adit {

/// End of a beam in a vertical plane: slope, horizontal range, what it hit, and the grade of the
/// ground there.
struct BeamEnd {
  enum class Kind : std::uint8_t {
    kGround,
    kObstacle,  ///< anything above the ground, walls and roof included
    kLost,      ///< no return where the ground is expected
  };

  float slope = 0.0F;    ///< rise over horizontal distance
  float range_m = 0.0F;  ///< horizontal
  float z_m = 0.0F;      ///< z of its end in level
  float grade = 0.0F;    ///< trend of the ground at its end, in its direction
  Kind kind = Kind::kGround;
};

/// Classifies the ends of single beams.
class BeamEnds {
 public:
  /// `ground` and `beams` must outlive this object.
  BeamEnds(const TerrainMap& map, const GroundLevel& ground, const PassingBeams& beams,
           const TerrainParams& params);

  /// Empty for points straight above or below the laser, and for points that are not usable.
  [[nodiscard]] std::optional<BeamEnd> of_point(const Eigen::Vector3f& origin,
                                                const Eigen::Vector3f& p_level) const;
  /// Empty if the ground is not expected near enough in this direction to return a beam, wherever
  /// passable ground may be.
  [[nodiscard]] std::optional<BeamEnd> of_miss(const Eigen::Vector3f& origin,
                                               const Eigen::Vector3f& direction) const;

 private:
  /// Whether a beam meets the least possible ground within the range of dry ground. `direction`: of
  /// a length of 1 in plan.
  [[nodiscard]] bool meets_lowest_ground(const Eigen::Vector3f& origin,
                                         const Eigen::Vector3f& direction) const;
  [[nodiscard]] float grade(int cell, const Eigen::Vector2f& direction) const;

  CellFinder finder_;
  const GroundLevel& ground_;
  const PassingBeams& beams_;
  float step_m_;
  float floor_range_m_;
  float cells_per_m_;
};

/// The lines of a cloud by viewpoint, in its order: those of a tilting laser begin within the lever
/// arm of its mount. Lines whose origin is not usable are left out.
std::vector<std::vector<const CloudLine*>> lines_by_viewpoint(const Cloud& cloud);

/// Mean origin of lines of one viewpoint, in level [m].
Eigen::Vector3f mean_origin(std::span<const CloudLine* const> lines);

/// Distance in plan from a point to the farthest corner of the map [m].
float reach_m(const TerrainMap& map, const Eigen::Vector3f& p_level);

/// The beams of a laser that carry information about the ground, by azimuth sector.
class SectorBeams {
 public:
  static constexpr std::size_t kSectors = 360;  ///< 0.64° to 1.27° wide: more than the beam spacing

  /// The sector of a direction of any length.
  [[nodiscard]] static std::size_t sector(float x, float y);

  SectorBeams(std::span<const CloudLine* const> lines, const BeamEnds& ends);

  [[nodiscard]] std::span<BeamEnd> of(std::size_t sector) {
    return std::span(beams_).subspan(starts_[sector], starts_[sector + 1] - starts_[sector]);
  }

 private:
  std::vector<std::uint32_t> starts_;  ///< start of the beams of each sector, and the end
  std::vector<BeamEnd> beams_;
};

}  // namespace adit
