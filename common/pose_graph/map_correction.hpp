// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"

namespace adit {

/// The pose of odom in map, `T_map_body = T_map_odom * T_odom_body`. It jumps.
struct MapCorrection {
  std::int64_t utime = 0;     ///< of the newest measurement in it [µs since the epoch]
  std::int64_t revision = 0;  ///< of the MapGraph that determines it
  int session = 0;            ///< of the odom frame, see LocalMap
  int local_map = 0;  ///< id of the newest local map, to which odom is anchored; an older one where
                      ///< the newest was discarded (see MappingParams::maps_per_place_max)
  Pose2 T_map_odom;

  /// Covariance of the pose of that local map in the map of earlier sessions, in which it is known
  /// best: (x, y, θ) in the frame of the local map [m², m rad, rad²]. Empty in the first session,
  /// which defines the map.
  std::optional<Eigen::Matrix3d> covariance;

  double z_map_odom_m = 0.0;  ///< height of odom in map
  double z_variance = 0.0;    ///< of the height of that local map above the first one [m²]

  /// Covariance of the pose of the body at its newest scan match relative to local map 0, whose
  /// origin is home: (x, y, θ) in the frame of the body [m², m rad, rad²].
  Eigen::Matrix3d body_covariance = Eigen::Matrix3d::Zero();

  friend bool operator==(const MapCorrection&, const MapCorrection&) = default;
};

/// When a loop closure moves odom in map, what was driven longer ago than this keeps its place in
/// map, and what was driven since that in odom: the path length of the newest two local maps [m].
inline constexpr double kKeepsPlaceInOdomM = 10.0;

/// How far a correction that moves what lies in odom moves it at a place there [m].
/// `T_after_before`: the old pose of odom in the new one.
inline double moved_at_m(const Pose2& T_after_before, const Eigen::Vector2d& p_odom) {
  return (T_after_before * p_odom - p_odom).norm();
}

/// Largest standard deviation of the position over all directions [m], of a covariance of (x, y,
/// θ).
inline double position_sd_m(const Eigen::Matrix3d& covariance) {
  const double mean = 0.5 * (covariance(0, 0) + covariance(1, 1));
  const double half = 0.5 * (covariance(0, 0) - covariance(1, 1));
  return std::sqrt(std::max(0.0, mean + std::hypot(half, covariance(0, 1))));
}

/// The same for the correction's local map; empty if unknown.
inline std::optional<double> position_sd_m(const MapCorrection& correction) {
  if (!correction.covariance) return std::nullopt;
  return position_sd_m(*correction.covariance);
}

/// Whether the pose of odom in map is accurate enough to transfer observations from another odom
/// frame: to 1.5 terrain cells and 3°. Always true in the first session.
inline bool odom_is_localized(const MapCorrection& correction) {
  constexpr double kSdMaxM = 0.15;
  constexpr double kSdMaxRad = 0.05;
  if (!correction.covariance) return true;
  const double sd_rad = std::sqrt(std::max(0.0, (*correction.covariance)(2, 2)));
  return *position_sd_m(correction) < kSdMaxM && sd_rad < kSdMaxRad;
}

}  // namespace adit
