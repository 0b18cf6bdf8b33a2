// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/sight_lines.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace adit {
namespace {

using Kind = BeamEnd::Kind;

constexpr float kSlopeMax = 0.5F;        // of beams that can say something of the ground
constexpr float kGapAlways = 0.3F;       // the width of a region, which bridges as much [m]
constexpr float kLaserHeightMin = 0.2F;  // [m]

/// The beams of a fan, sector by sector.
class SectorBeams {
 public:
  template <class SectorOf>
  SectorBeams(std::span<const CloudLine* const> lines, const BeamEnds& ends, std::size_t sectors,
              const SectorOf& sector_of)
      : starts_(sectors + 1, 0) {
    std::vector<std::pair<std::uint32_t, BeamEnd>> beams;
    const auto add = [&](const std::optional<BeamEnd>& end, const Eigen::Vector3f& direction) {
      if (!end || end->slope > kSlopeMax) return;
      beams.emplace_back(static_cast<std::uint32_t>(sector_of(direction.x(), direction.y())), *end);
      ++starts_[beams.back().first + 1];
    };
    for (const CloudLine* line : lines) {
      for (const auto& p : line->points) add(ends.of_point(line->origin, p), p - line->origin);
      for (const auto& miss : line->misses) add(ends.of_miss(line->origin, miss), miss);
    }
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    beams_.resize(beams.size());
    std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
    for (const auto& [sector, beam] : beams) beams_[next[sector]++] = beam;
  }

  [[nodiscard]] std::span<BeamEnd> of(std::size_t sector) {
    return std::span(beams_).subspan(starts_[sector], starts_[sector + 1] - starts_[sector]);
  }

 private:
  std::vector<std::uint32_t> starts_;  ///< of the beams of each sector, and the end
  std::vector<BeamEnd> beams_;
};

/// From a place to the farthest corner of the map.
float reach_m(const TerrainMap& map, const Eigen::Vector3f& origin) {
  const Eigen::Vector2d low = map.p_level_corner;
  const Eigen::Vector2d high = low + map.cell_m * Eigen::Vector2d(map.columns, map.rows);
  const Eigen::Vector2d place = origin.head<2>().cast<double>();
  return static_cast<float>((place - low).cwiseAbs().cwiseMax((high - place).cwiseAbs()).norm());
}

}  // namespace

SightLines::SightLines(std::span<const CloudLine* const> lines, const BeamEnds& ends,
                       const TerrainMap& map, const UnseenGroundParams& params)
    : params_(params), cell_m_(static_cast<float>(map.cell_m)) {
  for (const CloudLine* line : lines) origin_ += line->origin / static_cast<float>(lines.size());
  bins_ = static_cast<std::size_t>(reach_m(map, origin_) / cell_m_) + 2;
  sightings_.resize(kSectors * bins_);
  SectorBeams beams(lines, ends, kSectors, sector);
  for (std::size_t i = 0; i < kSectors; ++i) {
    look_along(beams.of(i), std::span(sightings_).subspan(i * bins_, bins_));
  }
}

const Sighting& SightLines::at(float x, float y) const {
  const Eigen::Vector2f d = Eigen::Vector2f(x, y) - origin_.head<2>();
  const auto bin = static_cast<std::size_t>(d.norm() / cell_m_);
  return sightings_[sector(d.x(), d.y()) * bins_ + std::min(bin, bins_ - 1)];
}

/// By a quantity that grows with the angle and needs no arc tangent.
std::size_t SightLines::sector(float x, float y) {
  const float sum = std::abs(x) + std::abs(y);
  if (!(sum > 0.0F)) return 0;
  const float quarters = x >= 0.0F ? 1.0F + y / sum : 3.0F - y / sum;  // 0 to 4
  return std::min(static_cast<std::size_t>(quarters * (kSectors / 4)), std::size_t{kSectors - 1});
}

/// From the steepest beam upwards: each shows what lies beyond the reach of those below it.
void SightLines::look_along(std::span<BeamEnd> beams, std::span<Sighting> out) const {
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
              Sighting{Ground::kShadow});
}

Sighting SightLines::between(const BeamEnd& below, const BeamEnd& above, float range_m) const {
  if (below.kind == Kind::kLost || above.kind == Kind::kLost) return {Ground::kNoReturn};
  if (below.kind == Kind::kObstacle) return {Ground::kShadow};
  if (is_gap(below, above)) return {Ground::kBelowRay, origin_.z() + above.slope * range_m};
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
