// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/laser/spinning_lidar_model.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <stdexcept>

namespace adit {
namespace {

/// A reading is one ray.
LaserParams one_ray(LaserParams params) {
  params.subrays = 1;
  return params;
}

}  // namespace

LidarRevolution SpinningLidarParams::revolution(double period_s) const {
  LidarRevolution revolution;
  for (int i = 0; i < rings; ++i) {
    const double share = static_cast<double>(i) / (rings - 1);
    const double elevation = std::lerp(elevation_min_rad, elevation_max_rad, share);
    revolution.rings.push_back({static_cast<float>(elevation), 0.0F, 0.0F});
  }
  for (int i = 0; i < columns; ++i) {
    const double share = (i + 0.5) / columns;
    revolution.columns.push_back(
        {static_cast<std::int32_t>(std::lround(1e6 * period_s * i / columns)),
         static_cast<float>(std::numbers::pi * (1.0 - 2.0 * share))});
  }
  revolution.ranges_m.assign(revolution.rings.size() * revolution.columns.size(),
                             std::numeric_limits<float>::quiet_NaN());
  return revolution;
}

SpinningLidarModel::SpinningLidarModel(const RayScene& scene, const SpinningLidarParams& params,
                                       const LaserParams& laser, double period_s,
                                       std::uint64_t seed)
    : scene_(scene),
      laser_(one_ray(laser)),
      finder_(scene, laser_),
      blank_(params.revolution(period_s)),
      random_(seed) {
  if (!(params.elevation_min_rad < params.elevation_max_rad)) {
    throw std::invalid_argument("sim: lidar.elevation_min_rad must be below elevation_max_rad");
  }
  for (std::size_t column = 0; column < blank_.columns.size(); ++column) {
    for (std::size_t ring = 0; ring < blank_.rings.size(); ++ring) {
      directions_.push_back(blank_.direction(column, ring));
    }
  }
  std::uniform_real_distribution<double> offset(-laser.offset_max_m, laser.offset_max_m);
  for (std::size_t ring = 0; ring < blank_.rings.size(); ++ring) {
    offsets_m_.push_back(offset(random_));
  }
}

LidarRevolution SpinningLidarModel::measure(const PoseAt& T_world_lidar, std::int64_t utime,
                                            const std::vector<bool>& measured) {
  LidarRevolution revolution = blank_;
  revolution.utime = utime;
  const std::size_t rings = blank_.rings.size();
  const auto is_measured = [&](std::size_t i) { return measured.empty() || measured[i]; };
  rays_.clear();
  for (std::size_t column = 0; column < blank_.columns.size(); ++column) {
    const Eigen::Isometry3d T = T_world_lidar(1e-6 * blank_.columns[column].time_us);
    const Eigen::Vector3f origin = T.translation().cast<float>();
    for (std::size_t i = column * rings; i < (column + 1) * rings; ++i) {
      if (!is_measured(i)) continue;
      const Eigen::Vector3d direction = T.linear() * directions_[i];
      rays_.push_back({origin, direction.cast<float>()});
    }
  }
  hits_.resize(rays_.size());
  scene_.cast(rays_, finder_.ray_length_m(), hits_);
  const auto no_return_m = static_cast<float>(laser_.no_return_m());
  std::size_t ray = 0;
  for (std::size_t i = 0; i < revolution.ranges_m.size(); ++i) {
    if (!is_measured(i)) continue;
    const double error_m = offsets_m_[i % rings] + laser_.noise_sd_m * normal_(random_);
    const auto range =
        finder_.range_m(std::span(rays_).subspan(ray, 1), std::span(hits_).subspan(ray, 1));
    const float reading_m = finder_.reading_m(range, error_m);
    revolution.ranges_m[i] =
        reading_m >= no_return_m ? std::numeric_limits<float>::infinity() : reading_m;
    ++ray;
  }
  return revolution;
}

}  // namespace adit
