// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/check_robot/lidar_ground.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace adit {

std::optional<LidarGround> lidar_ground(const Lasers& lasers, const SpinningLidarParams& lidar,
                                        double bearing_rad, double gap_max_m) {
  constexpr double kReachM = 100.0;
  const LidarRevolution revolution = lidar.revolution(1.0);
  const Eigen::Matrix3d R_body_lidar = T_body_lidar(lasers).linear();
  std::vector<double> distances_m;
  for (std::size_t ring = 0; ring < revolution.rings.size(); ++ring) {
    // The column that looks nearest to the bearing.
    double least_rad = 1.0;
    double distance_m = kReachM;
    for (std::size_t column = 0; column < revolution.columns.size(); ++column) {
      const Eigen::Vector3d d = R_body_lidar * revolution.direction(column, ring);
      const double off_rad =
          std::abs(std::remainder(std::atan2(d.y(), d.x()) - bearing_rad, 2.0 * std::numbers::pi));
      if (off_rad >= least_rad) continue;
      least_rad = off_rad;
      distance_m = d.z() < 0.0 ? lasers.front.height_m * d.head<2>().norm() / -d.z() : kReachM;
    }
    if (distance_m < kReachM) distances_m.push_back(distance_m);
  }
  if (distances_m.empty()) return std::nullopt;
  std::ranges::sort(distances_m);
  LidarGround ground{distances_m.front(), distances_m.front()};
  for (const double distance_m : distances_m) {
    if (distance_m - ground.to_m > gap_max_m) break;
    ground.to_m = distance_m;
  }
  return ground;
}

}  // namespace adit
