// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/sector_beams.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace adit {
namespace {

constexpr float kSlopeMax = 0.5F;  // steeper beams meet the roof, or walls from near by

/// With the sector of each.
std::vector<std::pair<std::size_t, BeamEnd>> useful_beams(std::span<const CloudLine* const> lines,
                                                          const BeamEnds& ends) {
  std::vector<std::pair<std::size_t, BeamEnd>> beams;
  const auto add = [&](const std::optional<BeamEnd>& end, const Eigen::Vector3f& direction) {
    if (!end || end->slope > kSlopeMax) return;
    beams.emplace_back(SectorBeams::sector(direction.x(), direction.y()), *end);
  };
  for (const CloudLine* line : lines) {
    for (const auto& p : line->points) add(ends.of_point(line->origin, p), p - line->origin);
    for (const auto& miss : line->misses) add(ends.of_miss(line->origin, miss), miss);
  }
  return beams;
}

}  // namespace

/// By a quantity that grows with the angle and needs no arc tangent.
std::size_t SectorBeams::sector(float x, float y) {
  const float sum = std::abs(x) + std::abs(y);
  if (!(sum > 0.0F)) return 0;
  const float quarters = x >= 0.0F ? 1.0F + y / sum : 3.0F - y / sum;  // 0 to 4
  return std::min(static_cast<std::size_t>(quarters / 4.0F * kSectors), kSectors - 1);
}

SectorBeams::SectorBeams(std::span<const CloudLine* const> lines, const BeamEnds& ends)
    : starts_(kSectors + 1, 0) {
  const auto beams = useful_beams(lines, ends);
  for (const auto& [sector, beam] : beams) ++starts_[sector + 1];
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  beams_.resize(beams.size());
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (const auto& [sector, beam] : beams) beams_[next[sector]++] = beam;
}

}  // namespace adit
