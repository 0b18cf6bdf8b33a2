// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/types/cloud.hpp"

namespace adit::test {

/// Distance to rock, positive in the open; at most 1.5 times the true one.
using Rock = std::function<double(const Eigen::Vector3d&)>;

/// A tunnel along x, 4 m wide and 2.5 m high, its origin on the floor.
inline double smooth_tunnel(const Eigen::Vector3d& p) {
  return std::min({p.z(), 2.5 - p.z(), 2.0 - p.y(), 2.0 + p.y()});
}

/// The same tunnel with bumps of 0.1 m on all sides.
inline double rough_tunnel(const Eigen::Vector3d& p) {
  const double bump = std::sin(2.1 * p.x() + p.y()) * std::cos(1.7 * p.z() + 0.4 * p.x()) +
                      std::sin(1.3 * p.x() - 1.1 * p.z() + 0.7 * p.y());
  return smooth_tunnel(p) + 0.05 * bump;
}

/// The rough tunnel with a grade of 20 % that begins at x = 4 m.
inline double rough_ramp(const Eigen::Vector3d& p) {
  return rough_tunnel(p - Eigen::Vector3d(0.0, 0.0, 0.2 * std::max(0.0, p.x() - 4.0)));
}

/// A sweep of the front laser from `T_world_level`, with noise of the ranges.
inline Cloud sweep(const Rock& rock, const Eigen::Isometry3d& T_world_level, unsigned seed) {
  constexpr double kNoiseSdM = 0.01;
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, kNoiseSdM);
  Cloud cloud;
  const Eigen::Vector3d origin(1.0, 0.0, 0.7);
  for (int tilt = -50; tilt <= 50; ++tilt) {
    CloudLine line;
    line.origin = origin.cast<float>();
    for (int beam = -90; beam <= 90; ++beam) {
      const double down = tilt * 0.0175;
      const double left = beam * 0.0175;
      const Eigen::Vector3d direction(std::cos(left) * std::cos(down), std::sin(left),
                                      -std::cos(left) * std::sin(down));
      double range_m = 0.0;
      for (int i = 0; i < 300 && range_m < 20.0; ++i) {
        const double free_m = rock(T_world_level * (origin + range_m * direction));
        if (free_m < 1e-4) break;
        range_m += 0.6 * free_m;
      }
      if (range_m >= 20.0) continue;
      const Eigen::Vector3d p = origin + (range_m + noise(random)) * direction;
      line.points.push_back(p.cast<float>());
    }
    cloud.lines.push_back(line);
  }
  return cloud;
}

/// In space, from roll, pitch and yaw.
inline Eigen::Isometry3d pose(double x, double y, double z, double roll, double pitch, double yaw) {
  return Eigen::Translation3d(x, y, z) * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX());
}

}  // namespace adit::test
