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

namespace adit {

/// How a beam ended, seen from the side: the plan distance from where it began, and what it met.
struct BeamEnd {
  enum class Kind : std::uint8_t {
    kGround,
    kObstacle,  ///< what stands or hangs above the ground, walls and roof included
    kLost,      ///< the ground should have been there, and nothing came back
  };

  float slope = 0.0F;  ///< rise over plan distance
  float range_m = 0.0F;
  float z_m = 0.0F;  ///< of its end, in level
  Kind kind = Kind::kGround;
};

/// Says of single beams how they ended.
class BeamEnds {
 public:
  /// `ground` must outlive this.
  BeamEnds(const TerrainMap& map, const GroundLevel& ground, const TerrainParams& params);

  /// Nothing for points straight above or below the laser, and those that are not usable.
  [[nodiscard]] std::optional<BeamEnd> of_point(const Eigen::Vector3f& origin,
                                                const Eigen::Vector3f& p_level) const;
  /// Nothing for a direction in which the ground is not expected near enough to return a beam.
  [[nodiscard]] std::optional<BeamEnd> of_miss(const Eigen::Vector3f& origin,
                                               const Eigen::Vector3f& direction) const;

 private:
  CellFinder finder_;
  const GroundLevel& ground_;
  float step_m_;
  float floor_range_m_;
};

/// The beams of a laser that can say something of the ground, by the direction in the plan.
class SectorBeams {
 public:
  static constexpr std::size_t kSectors = 360;  ///< 0.64° to 1.27° wide: more than beams are apart

  /// The sector that a direction lies in; its length does not matter.
  [[nodiscard]] static std::size_t sector(float x, float y);

  SectorBeams(std::span<const CloudLine* const> lines, const BeamEnds& ends);

  [[nodiscard]] std::span<BeamEnd> of(std::size_t sector) {
    return std::span(beams_).subspan(starts_[sector], starts_[sector + 1] - starts_[sector]);
  }

 private:
  std::vector<std::uint32_t> starts_;  ///< of the beams of each sector, and the end
  std::vector<BeamEnd> beams_;
};

}  // namespace adit
