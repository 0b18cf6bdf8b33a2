// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"

namespace adit {

/// One scan of a tilted laser, placed. The mirror hardly moves while it measures, so that one
/// origin stands for all of its beams.
struct CloudLine {
  std::int64_t utime = 0;                    ///< of its first beam [µs since the epoch]
  Eigen::Vector3f origin{0.0F, 0.0F, 0.0F};  ///< of the laser, in level [m]
  std::vector<Eigen::Vector3f> points;       ///< where beams met something, in level [m]
  std::vector<Eigen::Vector3f> misses;       ///< directions of those without return, unit, in level
};

/// A 3D scan: the lines of one tilt sweep in the frame "level", which has its origin where the
/// body's is at the end of the sweep, its x axis where the body's points in the plan, and its z
/// axis against gravity.
struct Cloud {
  std::int64_t utime = 0;  ///< end of the sweep [µs since the epoch]
  std::int32_t id = 0;     ///< of the request that it answers
  Pose2 T_odom_level;      ///< in the plan
  bool complete = true;    ///< false where the sweep was cut short
  std::vector<CloudLine> lines;

  [[nodiscard]] std::size_t points() const {
    std::size_t n = 0;
    for (const CloudLine& line : lines) n += line.points.size();
    return n;
  }
};

/// A stage says which 3D scans it has, and asks for the newest other one that is still held.
struct CloudRequest {
  static constexpr std::size_t kReceivedMax = 1000;

  std::int64_t utime = 0;                    ///< [µs since the epoch]
  std::string requested_by;                  ///< name of the stage
  std::int64_t after_utime = 0;              ///< none is asked for that ended then or before
  std::vector<std::int64_t> received_utime;  ///< of the newest that it has: Cloud::utime

  friend bool operator==(const CloudRequest&, const CloudRequest&) = default;
};

}  // namespace adit
