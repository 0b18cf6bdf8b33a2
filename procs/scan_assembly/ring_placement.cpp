// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_assembly/ring_placement.hpp"

#include <cmath>

namespace adit {

std::vector<CloudLine> RingPlacement::place(const LidarRevolution& revolution,
                                            const RangeImage& image) const {
  std::vector<CloudLine> lines(revolution.rings.size());
  if (revolution.columns.empty()) return {};
  const std::int64_t middle_us = revolution.columns[revolution.columns.size() / 2].time_us;
  const Eigen::Vector3f origin =
      T_level_lidar(revolution.utime + middle_us).translation().cast<float>();
  for (std::size_t ring = 0; ring < lines.size(); ++ring) {
    lines[ring].utime = revolution.utime_of(0, ring);
    lines[ring].origin = origin;
  }
  for (std::size_t column = 0; column < revolution.columns.size(); ++column) {
    const Eigen::Isometry3d T = T_level_lidar(revolution.utime_of(column, 0));
    for (std::size_t ring = 0; ring < lines.size(); ++ring) {
      const double range_m = image[ring][column];
      if (std::isnan(range_m)) continue;
      const Eigen::Vector3d direction = revolution.direction(column, ring);
      if (std::isinf(range_m)) {
        lines[ring].misses.push_back((T.linear() * direction).cast<float>());
      } else {
        lines[ring].points.push_back((T * (range_m * direction)).cast<float>());
      }
    }
  }
  return lines;
}

Eigen::Isometry3d RingPlacement::T_level_lidar(std::int64_t utime) const {
  const Pose2 T_odom_body = T_odom_body_.at(utime).value();
  Eigen::Isometry3d T_level_body = in_space(between(T_odom_level_, T_odom_body));
  T_level_body.rotate(R_level_body_);
  return T_level_body * T_body_lidar_;
}

}  // namespace adit
