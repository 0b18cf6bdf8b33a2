// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/sight_lines.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "procs/terrain/sector_beams.hpp"

namespace adit {
namespace {

using Kind = BeamEnd::Kind;

constexpr float kGapAlways = 0.3F;       // the width of a region, which bridges as much [m]
constexpr float kHidesM = 0.04F;         // above the ground, more than it is rough [m]
constexpr float kLaserHeightMin = 0.2F;  // [m]

/// From a place to the farthest corner of the map.
float reach_m(const TerrainMap& map, const Eigen::Vector3f& origin) {
  const Eigen::Vector2d low = map.p_level_corner;
  const Eigen::Vector2d high = low + map.cell_m * Eigen::Vector2d(map.columns, map.rows);
  const Eigen::Vector2d place = origin.head<2>().cast<double>();
  return static_cast<float>((place - low).cwiseAbs().cwiseMax((high - place).cwiseAbs()).norm());
}

/// Whether a rail, say, hides what lies between: a beam that passed over it and was nowhere below
/// the ground that is expected says nothing of a drop.
bool hides(const BeamEnd& below, const BeamEnd& above) {
  return below.above_m > kHidesM && above.above_m > -kHidesM;
}

}  // namespace

SightLines::SightLines(std::span<const CloudLine* const> lines, const BeamEnds& ends,
                       const TerrainMap& map, const UnseenGroundParams& params)
    : params_(params), cell_m_(static_cast<float>(map.cell_m)) {
  for (const CloudLine* line : lines) origin_ += line->origin / static_cast<float>(lines.size());
  bins_ = static_cast<std::size_t>(reach_m(map, origin_) / cell_m_) + 2;
  sightings_.resize(SectorBeams::kSectors * bins_);
  SectorBeams beams(lines, ends);
  for (std::size_t i = 0; i < SectorBeams::kSectors; ++i) {
    look_along(beams.of(i), std::span(sightings_).subspan(i * bins_, bins_));
  }
}

const SeenThrough& SightLines::at(float x, float y) const {
  const Eigen::Vector2f d = Eigen::Vector2f(x, y) - origin_.head<2>();
  const auto bin = static_cast<std::size_t>(d.norm() / cell_m_);
  return sightings_[SectorBeams::sector(d.x(), d.y()) * bins_ + std::min(bin, bins_ - 1)];
}

/// From the steepest beam upwards: each shows what lies beyond the reach of those below it.
void SightLines::look_along(std::span<BeamEnd> beams, std::span<SeenThrough> out) const {
  std::sort(beams.begin(), beams.end(), [](const BeamEnd& a, const BeamEnd& b) {
    return std::tie(a.slope, a.range_m, a.kind) < std::tie(b.slope, b.range_m, b.kind);
  });
  std::size_t done = 0;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const auto end = std::min(static_cast<std::size_t>(beams[i].range_m / cell_m_) + 1, bins_);
    for (; done < end; ++done) {
      // What lies before the steepest beam, nobody looked at.
      if (i > 0)
        out[done] = between(beams[i - 1], beams[i], (static_cast<float>(done) + 0.5F) * cell_m_);
    }
  }
  const bool hidden = !beams.empty() && beams.back().kind == Kind::kObstacle;
  if (hidden)
    std::fill(out.begin() + static_cast<std::ptrdiff_t>(done), out.end(),
              SeenThrough{Ground::kShadow});
}

SeenThrough SightLines::between(const BeamEnd& below, const BeamEnd& above, float range_m) const {
  if (below.kind == Kind::kLost || above.kind == Kind::kLost) return {Ground::kNoReturn};
  if (below.kind == Kind::kObstacle) return {Ground::kShadow};
  if (is_gap(below, above)) {
    if (hides(below, above)) return {Ground::kShadow};
    return {Ground::kBelowRay, origin_.z() + above.slope * range_m};
  }
  if (above.kind == Kind::kObstacle) return {Ground::kSeen, below.z_m};
  const float way = std::max(above.range_m - below.range_m, cell_m_);
  const float share = std::clamp((range_m - below.range_m) / way, 0.0F, 1.0F);
  return {Ground::kSeen, std::lerp(below.z_m, above.z_m, share)};
}

/// Beams that met the ground one behind the other show what is between, unless they are farther
/// apart than on level ground: then the upper one passed over a hollow, or a crest.
bool SightLines::is_gap(const BeamEnd& below, const BeamEnd& above) const {
  const float height = std::max(origin_.z(), kLaserHeightMin);
  const float spacing = below.range_m * below.range_m * (above.slope - below.slope) / height;
  const float gap_max = std::min(static_cast<float>(params_.gap_of_spacing) * spacing,
                                 static_cast<float>(params_.gap_max_m));
  return above.range_m - below.range_m > std::max(gap_max, kGapAlways);
}

}  // namespace adit
