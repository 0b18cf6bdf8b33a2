// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/beam_end.hpp"

#include <cmath>

namespace adit {
namespace {

constexpr float kRangeMin = 0.05F;  // below which a slope means nothing [m]
constexpr int kSteps = 4;           // to where a beam meets ground that rises and falls gently

}  // namespace

BeamEnds::BeamEnds(const TerrainMap& map, const GroundLevel& ground, const TerrainParams& params)
    : finder_(map),
      ground_(ground),
      step_m_(static_cast<float>(params.vehicle.step_max_m)),
      floor_range_m_(static_cast<float>(params.unseen.floor_range_m)) {}

std::optional<BeamEnd> BeamEnds::of_point(const Eigen::Vector3f& origin,
                                          const Eigen::Vector3f& p_level) const {
  if (!is_usable(p_level)) return std::nullopt;
  const float range = (p_level - origin).head<2>().norm();
  if (range < kRangeMin) return std::nullopt;
  BeamEnd end;
  end.slope = (p_level.z() - origin.z()) / range;
  end.range_m = range;
  end.z_m = p_level.z();
  const int cell = finder_.at(p_level.x(), p_level.y());
  // Outside of the map nobody knows the ground: what is below the laser may well be it.
  const float ground = cell == CellFinder::kOutside ? origin.z() - step_m_
                                                    : ground_.at(static_cast<std::size_t>(cell));
  end.above_m = p_level.z() - ground;
  end.kind = end.above_m <= step_m_ ? BeamEnd::Kind::kGround : BeamEnd::Kind::kObstacle;
  return end;
}

std::optional<BeamEnd> BeamEnds::of_miss(const Eigen::Vector3f& origin,
                                         const Eigen::Vector3f& direction) const {
  const float plan = direction.head<2>().norm();
  if (!is_usable(direction) || !(plan > 0.0F) || direction.z() >= 0.0F) return std::nullopt;
  const float slope = direction.z() / plan;
  float range = 0.0F;
  float ground = 0.0F;
  for (int i = 0; i < kSteps; ++i) {
    range = (ground - origin.z()) / slope;
    if (!(range >= kRangeMin && range <= floor_range_m_)) return std::nullopt;
    const Eigen::Vector2f p = origin.head<2>() + range / plan * direction.head<2>();
    const int cell = finder_.at(p.x(), p.y());
    if (cell == CellFinder::kOutside) return std::nullopt;
    ground = ground_.at(static_cast<std::size_t>(cell));
  }
  return BeamEnd{slope, range, ground, 0.0F, BeamEnd::Kind::kLost};
}

}  // namespace adit
