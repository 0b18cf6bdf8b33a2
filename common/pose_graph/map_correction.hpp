// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Core>

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

}  // namespace adit
