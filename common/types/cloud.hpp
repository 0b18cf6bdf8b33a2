// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"

namespace adit {

/// One scan of a tilted laser in the level frame. The mirror hardly moves during a scan, so one
/// origin serves all beams.
struct CloudLine {
  std::int64_t utime = 0;                    ///< time of the first beam [µs since the epoch]
  Eigen::Vector3f origin{0.0F, 0.0F, 0.0F};  ///< position of the laser in level [m]
  std::vector<Eigen::Vector3f> points;       ///< returns, in level [m]
  std::vector<Eigen::Vector3f>
      misses;  ///< directions of beams without return, unit vectors in level
};

/// A 3D scan: the lines of one tilt sweep in the frame "level". Its origin is that of the body at
/// the end of the sweep, its x axis the horizontal projection of the body's, its z axis opposite to
/// gravity. Those of a spinning lidar have one for each ring and revolution, those at rest first.
struct Cloud {
  std::int64_t utime = 0;  ///< end of the sweep [µs since the epoch]
  std::int32_t id = 0;     ///< id of the request
  Pose2 T_odom_level;      ///< planar pose of level in odom
  bool complete = true;    ///< false if the sweep ended early
  std::vector<CloudLine> lines;
  double z_odom_m = 0.0;  ///< height of level in odom

  [[nodiscard]] std::size_t points() const {
    std::size_t n = 0;
    for (const CloudLine& line : lines) n += line.points.size();
    return n;
  }
};

/// Whether a line begins where the first one does, within the lever arm of a tilting laser. Lines
/// that a spinning lidar saw while the robot drove there do not; odometry has placed them.
inline bool is_at_place(const Cloud& cloud, const CloudLine& line) {
  constexpr float kPlaceM = 0.5F;
  return (line.origin - cloud.lines.front().origin).norm() <= kPlaceM;
}

/// Requests the newest 3D scan that scan assembly still holds and the stage has not received.
struct CloudRequest {
  static constexpr std::size_t kReceivedMax = 1000;

  std::int64_t utime = 0;                    ///< [µs since the epoch]
  std::int64_t after_utime = 0;              ///< scans that ended then or before are not requested
  std::vector<std::int64_t> received_utime;  ///< Cloud::utime of the newest received scans

  friend bool operator==(const CloudRequest&, const CloudRequest&) = default;
};

}  // namespace adit
