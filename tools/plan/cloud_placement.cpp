// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/plan/cloud_placement.hpp"

#include <array>
#include <stdexcept>
#include <utility>

#include <Eigen/Geometry>

#include "tools/plan/ground_estimate.hpp"

namespace adit {
namespace {

constexpr double kLaserHeightMinM = 0.05;

struct Upright {
  std::vector<Eigen::Vector3d> points;
  Eigen::Vector3d laser;
};

Upright turn(const PointCloud& cloud, const CloudPlacement& placement) {
  const Eigen::Matrix3d R = upright(placement.up);
  const Eigen::Vector3d origin = cloud.sensor.value_or(Eigen::Vector3d::Zero());
  Upright turned{{}, R * placement.p_file_laser.value_or(origin)};
  turned.points.reserve(cloud.points.size());
  for (const Eigen::Vector3d& p : cloud.points) turned.points.emplace_back(R * p);
  return turned;
}

/// About the laser, so that the plan below it stays where it is.
void turn_level(Upright& cloud, const Eigen::Vector2d& p_plan) {
  const Eigen::Vector3d normal = estimate_ground_normal(cloud.points, p_plan, cloud.laser.z());
  const auto R = Eigen::Quaterniond::FromTwoVectors(normal, Eigen::Vector3d::UnitZ());
  for (Eigen::Vector3d& p : cloud.points) p = cloud.laser + R * (p - cloud.laser);
}

}  // namespace

Eigen::Matrix3d upright(const std::string& up) {
  using V = Eigen::Vector3d;
  const std::array<std::pair<const char*, std::pair<V, V>>, 6> axes{
      {{"z", {V::UnitX(), V::UnitY()}},
       {"y", {V::UnitX(), -V::UnitZ()}},
       {"x", {V::UnitY(), V::UnitZ()}},
       {"-z", {V::UnitX(), -V::UnitY()}},
       {"-y", {V::UnitZ(), -V::UnitX()}},
       {"-x", {V::UnitZ(), V::UnitY()}}}};
  for (const auto& [name, plan] : axes) {
    if (up != name) continue;
    Eigen::Matrix3d R;
    R << plan.first.transpose(), plan.second.transpose(), plan.first.cross(plan.second).transpose();
    return R;
  }
  throw std::invalid_argument("'" + up + "' is none of the axes x, y, z, -x, -y, -z");
}

Cloud place_cloud(const PointCloud& points, const CloudPlacement& placement) {
  Upright cloud = turn(points, placement);
  const Eigen::Vector2d p_plan = placement.p_plan_vehicle.value_or(cloud.laser.head<2>());
  if (placement.level) turn_level(cloud, p_plan);
  const double ground_m = placement.ground_m
                              ? *placement.ground_m
                              : estimate_ground_height(cloud.points, p_plan, cloud.laser.z());
  if (cloud.laser.z() < ground_m + kLaserHeightMinM) {
    throw std::runtime_error("the laser is not above the ground: see --origin, --ground and --up");
  }
  const Eigen::Isometry3d T_level_upright =
      Eigen::AngleAxisd(-placement.heading_rad, Eigen::Vector3d::UnitZ()) *
      Eigen::Translation3d(-p_plan.x(), -p_plan.y(), -ground_m);
  CloudLine line;
  line.origin = (T_level_upright * cloud.laser).cast<float>();
  line.points.reserve(cloud.points.size());
  for (const Eigen::Vector3d& p : cloud.points) {
    line.points.emplace_back((T_level_upright * p).cast<float>());
  }
  Cloud placed;
  placed.lines.push_back(std::move(line));
  return placed;
}

}  // namespace adit
