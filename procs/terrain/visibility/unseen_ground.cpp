// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/visibility/unseen_ground.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include "procs/terrain/visibility/beams.hpp"

namespace adit {
namespace {

using Kind = BeamEnd::Kind;

constexpr float kGapAlways = 0.3F;       // a gap up to the width of a region is always bridged [m]
constexpr float kLaserHeightMin = 0.2F;  // [m]
constexpr float kFootM = 0.5F;           // distance before a crest within which its foot lies
constexpr float kCrestMinM = 0.07F;      // height above the foot: lower crests may be noise
constexpr float kLevelM = 0.1F;          // by how much ground behind a crest may be lower
constexpr float kEndNoiseM = 0.1F;       // tolerance of the length of a shadow

/// Widest ditch into which a wheel sinks by at most three quarters of a step: the chord of the
/// wheel at that height.
float bridged_by_wheel_m(const Vehicle& vehicle) {
  const double radius = vehicle.wheel_radius_m;
  const double depth = std::min(0.75 * vehicle.step_max_m, radius);
  return static_cast<float>(2.0 * std::sqrt(depth * (2.0 * radius - depth)));
}

/// Lowest z of the ground within kFootM before the last of these beams, which are ordered by slope,
/// moved to its end along the trend of the ground.
float foot_m(std::span<const BeamEnd> beams) {
  const BeamEnd& crest = beams.back();
  float low = crest.z_m;
  for (auto beam = beams.rbegin(); beam != beams.rend(); ++beam) {
    if (beam->range_m < crest.range_m - kFootM) break;
    if (beam->kind != Kind::kGround) continue;
    low = std::min(low, beam->z_m + crest.grade * (crest.range_m - beam->range_m));
  }
  return low;
}

}  // namespace

SightLines::SightLines(std::span<const CloudLine* const> lines, const BeamEnds& ends,
                       const TerrainMap& map, const TerrainParams& params)
    : params_(params.unseen),
      bridged_m_(bridged_by_wheel_m(params.vehicle)),
      cell_m_(static_cast<float>(map.cell_m)),
      origin_(mean_origin(lines)) {
  bins_ = static_cast<std::size_t>(reach_m(map, origin_) / cell_m_) + 2;
  observations_.resize(SectorBeams::kSectors * bins_);
  SectorBeams beams(lines, ends);
  for (std::size_t i = 0; i < SectorBeams::kSectors; ++i) {
    classify_sector(beams.of(i), std::span(observations_).subspan(i * bins_, bins_));
  }
}

const GroundEvidence& SightLines::at(float x, float y) const {
  const Eigen::Vector2f d = Eigen::Vector2f(x, y) - origin_.head<2>();
  const auto bin = static_cast<std::size_t>(d.norm() / cell_m_);
  return observations_[SectorBeams::sector(d.x(), d.y()) * bins_ + std::min(bin, bins_ - 1)];
}

/// From the steepest beam upwards: each beam covers the distances beyond the reach of those below
/// it.
void SightLines::classify_sector(std::span<BeamEnd> beams, std::span<GroundEvidence> out) const {
  std::sort(beams.begin(), beams.end(), [](const BeamEnd& a, const BeamEnd& b) {
    return std::tie(a.slope, a.range_m, a.kind) < std::tie(b.slope, b.range_m, b.kind);
  });
  std::size_t done = 0;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const auto end = std::min(static_cast<std::size_t>(beams[i].range_m / cell_m_) + 1, bins_);
    if (i > 0 && done < end) {
      const Gap gap{beams[i - 1], beams[i], foot_m(beams.first(i))};
      for (; done < end; ++done)
        out[done] = between(gap, (static_cast<float>(done) + 0.5F) * cell_m_);
    }
    done = std::max(done, end);  // distances before the steepest beam are not observed
  }
  const bool is_occluded = !beams.empty() && beams.back().kind == Kind::kObstacle;
  if (is_occluded)
    std::fill(out.begin() + static_cast<std::ptrdiff_t>(done), out.end(),
              GroundEvidence{Ground::kOccluded});
}

GroundEvidence SightLines::between(const Gap& gap, float range_m) const {
  const auto& [below, above, foot_m] = gap;
  if (above.kind == Kind::kLost || (below.kind == Kind::kLost && !passes_over(gap)))
    return {Ground::kNoReturn};
  if (below.kind == Kind::kObstacle) return {Ground::kOccluded};
  const float gap_m = std::max(above.range_m - below.range_m, cell_m_);
  const float share = std::clamp((range_m - below.range_m) / gap_m, 0.0F, 1.0F);
  if (passes_over(gap) && !is_bridged(gap)) {
    const bool behind_crest = below.kind == Kind::kGround && is_behind_crest(gap);
    if (!behind_crest) return {Ground::kBelowRay, origin_.z() + above.slope * range_m};
    if (gap_m > bridged_m_ + spacing_m(gap) / static_cast<float>(params_.gap_of_spacing))
      return {Ground::kOccluded};
    return {Ground::kObserved, std::lerp(foot_m, above.z_m, share)};
  }
  if (above.kind == Kind::kObstacle) return {Ground::kObserved, below.z_m};
  return {Ground::kObserved, std::lerp(below.z_m, above.z_m, share)};
}

/// At a crest the trends at both ends of the gap differ: the lesser height allows wider gaps.
float SightLines::laser_height_m(const Gap& gap) const {
  const auto above_plane = [&](const BeamEnd& end, float grade) {
    return origin_.z() - (end.z_m - grade * end.range_m);
  };
  const float height = above_plane(gap.below, gap.below.grade);
  if (gap.above.kind != Kind::kGround) return height;
  return std::min(height, above_plane(gap.below, gap.above.grade));
}

/// Distance up to which two beams that hit even ground may be apart [m].
float SightLines::spacing_m(const Gap& gap) const {
  const auto& [below, above, foot_m] = gap;
  const float height = std::max(laser_height_m(gap), kLaserHeightMin);
  const float spacing = below.range_m * below.range_m * (above.slope - below.slope) / height;
  return std::min(static_cast<float>(params_.gap_of_spacing) * spacing,
                  static_cast<float>(params_.gap_max_m));
}

/// Consecutive beams that hit the ground show the ground between them, unless they are farther
/// apart than on level ground: then the upper one passed over a hollow or a crest.
bool SightLines::passes_over(const Gap& gap) const {
  return gap.above.range_m - gap.below.range_m > std::max(spacing_m(gap), kGapAlways);
}

/// Whether ground that a vehicle can drive on ends at both sides of a ditch that is not wide enough
/// to stop a wheel, however deep it is. On slopes that fall ahead beams are far apart.
bool SightLines::is_bridged(const Gap& gap) const {
  const auto& [below, above, foot_m] = gap;
  const float gap_m = above.range_m - below.range_m;
  return below.kind == Kind::kGround && above.kind == Kind::kGround && gap_m <= bridged_m_ &&
         std::abs(above.z_m - below.z_m) <= GroundTrend::kGradeMax * gap_m;
}

/// Whether the ground continues behind a low crest, a rail for example, that hides no more than its
/// shadow. The ground in the shadow is not observed; a wheel crosses a short shadow regardless of
/// it.
bool SightLines::is_behind_crest(const Gap& gap) const {
  const auto& [below, above, foot_m] = gap;
  const float height = below.z_m - foot_m;
  const float beam_height = laser_height_m(gap);
  if (above.kind != Kind::kGround || height < kCrestMinM || !(beam_height > 0.0F)) return false;
  const float gap_m = above.range_m - below.range_m;
  if (above.z_m < foot_m + below.grade * gap_m - kLevelM) return false;
  const float shadow = below.range_m * height / beam_height;
  return gap_m <= shadow + spacing_m(gap) + kEndNoiseM;
}

namespace {

int evidence_rank(Ground ground) {
  switch (ground) {
    case Ground::kObserved:
      return 4;
    case Ground::kNoReturn:
      return 3;
    case Ground::kBelowRay:
      return 2;
    case Ground::kOccluded:
      return 1;
    case Ground::kNeverObserved:
      break;
  }
  return 0;
}

bool has_more_evidence(const GroundEvidence& observation, const TerrainCell& cell) {
  if (observation.ground == Ground::kBelowRay && cell.ground == Ground::kBelowRay) {
    return observation.height_m < cell.low_m;
  }
  return evidence_rank(observation.ground) > evidence_rank(cell.ground);
}

/// Whether a cell has points of its own below the roof, which over a pit shows nothing of the
/// floor.
bool has_own_points(const TerrainCell& cell, float lowest_m, float headroom_m) {
  return cell.ground == Ground::kObserved && lowest_m <= cell.low_m + headroom_m;
}

/// A region extends beyond the last points of the ground before a drop: a cell without points of
/// its own is not ground if beams pass over it. In the shadow of what stands on the ground it is.
bool is_past_edge(const GroundEvidence& observation, const TerrainCell& cell, float step_max_m) {
  const bool missed =
      observation.ground == Ground::kBelowRay || observation.ground == Ground::kNoReturn;
  return missed && cell.ground == Ground::kObserved && cell.high_m - cell.low_m < step_max_m;
}

void apply(const GroundEvidence& observation, TerrainCell& cell, float step_max_m) {
  if (!has_more_evidence(observation, cell) && !is_past_edge(observation, cell, step_max_m)) return;
  cell.ground = observation.ground;
  cell.low_m = observation.height_m;
  cell.high_m = observation.ground == Ground::kObserved ? observation.height_m
                                                        : std::numeric_limits<float>::quiet_NaN();
  cell.count = 0;
}

}  // namespace

void classify_unseen_ground(TerrainMap& map, const Cloud& cloud, const CellHeights& heights,
                            const GroundLevel& ground, const PassingBeams& beams,
                            const TerrainParams& params) {
  const auto step_max_m = static_cast<float>(params.vehicle.step_max_m);
  const auto headroom_m = static_cast<float>(params.headroom_m());
  const BeamEnds ends(map, ground, beams, params);
  for (const auto& lines : lines_by_viewpoint(cloud)) {
    const SightLines sight(lines, ends, map, params);
    for (int row = 0; row < map.cells.rows(); ++row) {
      for (int column = 0; column < map.cells.columns(); ++column) {
        TerrainCell& cell = map.cells.at({column, row});
        if (has_own_points(cell, heights.lowest_m(column, row), headroom_m)) continue;
        const Eigen::Vector2f p = map.centre(column, row).cast<float>();
        apply(sight.at(p.x(), p.y()), cell, step_max_m);
      }
    }
  }
}

}  // namespace adit
