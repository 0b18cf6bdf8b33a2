// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/visibility/beams.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace adit {
namespace {

constexpr float kRangeMin = 0.05F;  // below it a slope is not significant [m]
constexpr int kSteps = 4;  // iterations to the intersection of a beam with gently sloping ground

constexpr float kViewpointRadius = 0.25F;  // radius within which a tilting laser stays [m]

}  // namespace

std::vector<std::vector<const CloudLine*>> lines_by_viewpoint(const Cloud& cloud) {
  std::vector<std::vector<const CloudLine*>> places;
  for (const CloudLine& line : cloud.lines) {
    if (!is_usable(line.origin)) continue;
    auto place = places.begin();
    while (place != places.end() &&
           (place->front()->origin - line.origin).norm() > kViewpointRadius) {
      ++place;
    }
    if (place == places.end()) place = places.insert(place, std::vector<const CloudLine*>{});
    place->push_back(&line);
  }
  return places;
}

Eigen::Vector3f mean_origin(std::span<const CloudLine* const> lines) {
  Eigen::Vector3f origin = Eigen::Vector3f::Zero();
  for (const CloudLine* line : lines) origin += line->origin / static_cast<float>(lines.size());
  return origin;
}

float reach_m(const TerrainMap& map, const Eigen::Vector3f& p_level) {
  const Eigen::Vector2d low = map.p_level_corner;
  const Eigen::Vector2d high = low + map.cell_m * map.cells.box().to.cast<double>();
  const Eigen::Vector2d place = p_level.head<2>().cast<double>();
  return static_cast<float>((place - low).cwiseAbs().cwiseMax((high - place).cwiseAbs()).norm());
}

BeamEnds::BeamEnds(const TerrainMap& map, const GroundLevel& ground, const PassingBeams& beams,
                   const TerrainParams& params)
    : finder_(map),
      ground_(ground),
      beams_(beams),
      step_m_(static_cast<float>(params.vehicle.step_max_m)),
      floor_range_m_(static_cast<float>(params.unseen.floor_range_m)),
      cells_per_m_(static_cast<float>(1.0 / map.cell_m)) {}

float BeamEnds::grade(int cell, const Eigen::Vector2f& direction) const {
  if (cell == CellFinder::kOutside) return 0.0F;
  return cells_per_m_ * ground_.trend().rise_m(static_cast<std::size_t>(cell)).dot(direction);
}

std::optional<BeamEnd> BeamEnds::of_point(const Eigen::Vector3f& origin,
                                          const Eigen::Vector3f& p_level) const {
  if (!is_usable(p_level)) return std::nullopt;
  const Eigen::Vector2f away = (p_level - origin).head<2>();
  const float range = away.norm();
  if (range < kRangeMin) return std::nullopt;
  const int cell = finder_.at(p_level.x(), p_level.y());
  BeamEnd end{(p_level.z() - origin.z()) / range, range, p_level.z(), grade(cell, away / range),
              BeamEnd::Kind::kObstacle};
  // Outside the map the ground is unknown: anything well below the laser may be ground.
  const float ground = cell == CellFinder::kOutside ? origin.z() - step_m_
                                                    : ground_.at(static_cast<std::size_t>(cell));
  if (p_level.z() > ground + step_m_) return end;
  if (!beams_.pass_below(p_level.head<2>(), p_level.z())) end.kind = BeamEnd::Kind::kGround;
  return end;
}

/// Behind an edge ground may be so much lower than expected that a beam meets it too far away.
bool BeamEnds::meets_lowest_ground(const Eigen::Vector3f& origin,
                                   const Eigen::Vector3f& direction) const {
  const float step_m = 1.0F / cells_per_m_;
  for (float range_m = step_m; range_m <= floor_range_m_; range_m += step_m) {
    const Eigen::Vector3f p = origin + range_m * direction;
    const int cell = finder_.at(p.x(), p.y());
    if (cell == CellFinder::kOutside) return false;
    if (p.z() <= ground_.least_m(static_cast<std::size_t>(cell))) return true;
  }
  return false;
}

std::optional<BeamEnd> BeamEnds::of_miss(const Eigen::Vector3f& origin,
                                         const Eigen::Vector3f& direction) const {
  const float horizontal = direction.head<2>().norm();
  if (!is_usable(direction) || !(horizontal > 0.0F) || direction.z() >= 0.0F) return std::nullopt;
  const float slope = direction.z() / horizontal;
  float range = 0.0F;
  float ground = 0.0F;
  int cell = CellFinder::kOutside;
  for (int i = 0; i < kSteps; ++i) {
    range = (ground - origin.z()) / slope;
    if (!(range >= kRangeMin && range <= floor_range_m_)) return std::nullopt;
    const Eigen::Vector2f p = origin.head<2>() + range / horizontal * direction.head<2>();
    cell = finder_.at(p.x(), p.y());
    if (cell == CellFinder::kOutside) return std::nullopt;
    ground = ground_.at(static_cast<std::size_t>(cell));
  }
  if (!meets_lowest_ground(origin, direction / horizontal)) return std::nullopt;
  return BeamEnd{slope, range, ground, grade(cell, direction.head<2>() / horizontal),
                 BeamEnd::Kind::kLost};
}

namespace {

constexpr float kSlopeMax = 0.5F;  // steeper beams hit the roof, or walls nearby

/// Beams with their sector.
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

/// Uses a pseudo-angle that grows with the azimuth and needs no arc tangent.
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
