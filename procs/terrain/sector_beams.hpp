// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "procs/terrain/beam_end.hpp"

namespace adit {

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
