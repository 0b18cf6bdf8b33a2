// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include "common/geometry/pose2.hpp"

namespace adit {

/// Where odom is in map, so that `T_map_body = T_map_odom * T_odom_body`. It jumps.
struct MapCorrection {
  std::int64_t utime = 0;     ///< of the newest measurement in it [µs since the epoch]
  std::int64_t revision = 0;  ///< of the MapGraph from which it follows
  int session = 0;            ///< of the odom frame, see LocalMap
  int local_map = 0;          ///< id of the newest local map, to which odom is tied; an older one
                              ///< where the body is in a place of which no more are kept
  Pose2 T_map_odom;

  /// Of the pose of that local map in the map of the sessions before, where it is known best: (x,
  /// y, θ) in the frame of the local map [m², m rad, rad²]. Nothing in the first session, which is
  /// in no doubt about its own map.
  std::optional<Eigen::Matrix3d> covariance;

  friend bool operator==(const MapCorrection&, const MapCorrection&) = default;
};

/// Standard deviation of the position of the local map of a correction, in the direction in which
/// it is greatest [m]; nothing where that is not known.
inline std::optional<double> position_sd_m(const MapCorrection& correction) {
  if (!correction.covariance) return std::nullopt;
  const Eigen::Matrix2d covariance = correction.covariance->topLeftCorner<2, 2>();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, axes.eigenvalues().maxCoeff()));
}

/// Whether odom is known on the map well enough to carry over into it what was seen in another
/// odom, by a cell and a half of the terrain and 3°. In the first session there is no doubt.
inline bool odom_is_localized(const MapCorrection& correction) {
  constexpr double kSdMaxM = 0.15;
  constexpr double kSdMaxRad = 0.05;
  if (!correction.covariance) return true;
  const double sd_rad = std::sqrt(std::max(0.0, (*correction.covariance)(2, 2)));
  return *position_sd_m(correction) < kSdMaxM && sd_rad < kSdMaxRad;
}

}  // namespace adit
