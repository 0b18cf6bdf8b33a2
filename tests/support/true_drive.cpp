// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/true_drive.hpp"

#include <algorithm>
#include <cmath>

#include "sim/vehicle/body_clearance.hpp"
#include "sim/vehicle/standing_water.hpp"

namespace adit {
namespace {

constexpr double kStepM = 0.01;   // of the outermost points, from one look to the next
constexpr double kCornerM = 1.4;  // from the middle to a corner, at least

}  // namespace

std::optional<std::string> fault_around(const Site& site, const Vehicle& vehicle,
                                        const Eigen::Isometry3d& T_world_body) {
  if (const auto part = touched_part(site.scene(), vehicle, T_world_body)) {
    return "touches '" + *part + "'";
  }
  for (const double x : {-0.5, 0.0, 0.5}) {
    for (const double y : {-0.5, 0.0, 0.5}) {
      const Eigen::Vector3d p =
          T_world_body * Eigen::Vector3d(x * vehicle.wheelbase_m, y * vehicle.track_m, 0.0);
      const auto water = water_above(site.world(), p);
      if (water && water->depth_m > vehicle.wading_depth_max_m) return "in deep water";
    }
  }
  return std::nullopt;
}

std::optional<DriveFault> first_fault(const Site& site, const Vehicle& vehicle, double floor_m,
                                      const std::vector<Pose2>& poses) {
  if (poses.empty()) return std::nullopt;
  Stance stance(site, vehicle);
  double way_m = 0.0;
  const auto fault_at = [&](const Pose2& pose, Stance::Fault fault) -> std::optional<DriveFault> {
    if (!fault) fault = fault_around(site, vehicle, stance.T_world_body());
    if (!fault) return std::nullopt;
    return DriveFault{pose, way_m, *fault};
  };
  if (auto fault = fault_at(poses.front(), stance.put(poses.front(), floor_m))) return fault;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const Pose2 step = between(poses[i - 1], poses[i]);
    const double length_m = step.translation().norm();
    const int pieces =
        static_cast<int>(std::ceil((length_m + kCornerM * std::abs(step.theta)) / kStepM));
    for (int k = 1; k <= pieces; ++k) {
      const double share = static_cast<double>(k) / pieces;
      const Pose2 pose = poses[i - 1] * Pose2{share * step.x, share * step.y, share * step.theta};
      way_m += length_m / pieces;
      if (auto fault = fault_at(pose, stance.move(pose))) return fault;
    }
  }
  return std::nullopt;
}

}  // namespace adit
