// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/plan/cloud_placement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "common/geometry/order_statistics.hpp"
#include "common/geometry/symmetric_eigen.hpp"
#include "common/text/message_text.hpp"

namespace adit {
namespace {

constexpr double kRadiusM = 5.0;
constexpr double kCellM = 0.25;
constexpr double kBelowLaserM = 0.1;
constexpr std::size_t kRank = 3;  // k-th lowest point of a cell, robust to outliers below
constexpr std::size_t kCellsNearest = 60;
constexpr std::size_t kCellsMin = 10;
constexpr int kRefinements = 20;
constexpr double kNoiseM = 0.01;
constexpr double kLaserHeightMinM = 0.05;

/// The kRank-th lowest point of each cell within kRadiusM, sorted by distance from `p_plan`.
std::vector<Eigen::Vector3d> low_points(const std::vector<Eigen::Vector3d>& points,
                                        const Eigen::Vector2d& p_plan, double laser_z_m) {
  std::map<std::pair<int, int>, std::vector<Eigen::Vector3d>> lowest;
  const auto is_lower = [](const auto& a, const auto& b) { return a.z() < b.z(); };
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector2d d = p.head<2>() - p_plan;
    if (p.z() > laser_z_m - kBelowLaserM || d.norm() > kRadiusM) continue;
    auto& cell = lowest[{static_cast<int>(std::floor(d.x() / kCellM)),
                         static_cast<int>(std::floor(d.y() / kCellM))}];
    cell.insert(std::upper_bound(cell.begin(), cell.end(), p, is_lower), p);
    if (cell.size() > kRank) cell.pop_back();
  }
  std::vector<Eigen::Vector3d> low;
  for (const auto& [index, cell] : lowest) low.push_back(cell.back());
  std::stable_sort(low.begin(), low.end(), [&](const auto& a, const auto& b) {
    return (a.template head<2>() - p_plan).norm() < (b.template head<2>() - p_plan).norm();
  });
  if (low.size() < kCellsMin) {
    throw std::runtime_error("no ground points near the vehicle: see --ground-m and --laser-at");
  }
  return low;
}

double median_height(std::vector<Eigen::Vector3d> points) {
  const auto middle = points.begin() + static_cast<std::ptrdiff_t>(points.size() / 2);
  std::nth_element(points.begin(), middle, points.end(),
                   [](const auto& a, const auto& b) { return a.z() < b.z(); });
  return middle->z();
}

struct Plane {
  Eigen::Vector3d centroid;
  Eigen::Vector3d normal;
};

/// Least-squares plane; the normal points up.
Plane fit_plane(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  for (const auto& p : points) centroid += p / static_cast<double>(points.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const auto& p : points) scatter += (p - centroid) * (p - centroid).transpose();
  const Eigen::Vector3d normal = symmetric_eigen(scatter).vectors.col(0);
  return {centroid, normal.z() < 0.0 ? Eigen::Vector3d(-normal) : normal};
}

struct Upright {
  std::vector<Eigen::Vector3d> points;
  Eigen::Vector3d laser;
};

Upright rotate_upright(const PointCloud& cloud, const CloudPlacement& placement) {
  const Eigen::Matrix3d R = upright(placement.up);
  const Eigen::Vector3d origin = cloud.sensor.value_or(Eigen::Vector3d::Zero());
  Upright rotated{{}, R * placement.p_file_laser.value_or(origin)};
  rotated.points.reserve(cloud.points.size());
  for (const Eigen::Vector3d& p : cloud.points) rotated.points.emplace_back(R * p);
  return rotated;
}

/// The shortest rotation from a unit vector that points upwards to the z axis.
Eigen::Quaterniond from_up_to_z(const Eigen::Vector3d& up) {
  const double s = std::sqrt(2.0 * (1.0 + up.z()));  // twice the cosine of half the angle
  return {0.5 * s, up.y() / s, -up.x() / s, 0.0};
}

/// Rotates about the laser, so that the horizontal position of the laser does not change.
void level(Upright& cloud, const Eigen::Vector2d& p_plan) {
  const Eigen::Vector3d normal = estimate_ground_normal(cloud.points, p_plan, cloud.laser.z());
  const Eigen::Quaterniond R = from_up_to_z(normal);
  for (Eigen::Vector3d& p : cloud.points) p = cloud.laser + R * (p - cloud.laser);
}

}  // namespace

double estimate_ground_height(const std::vector<Eigen::Vector3d>& points,
                              const Eigen::Vector2d& p_plan, double laser_z_m) {
  std::vector<Eigen::Vector3d> low = low_points(points, p_plan, laser_z_m);
  low.resize(std::min(low.size(), kCellsNearest));
  return median_height(std::move(low));
}

/// Fits a plane to all cells, then repeatedly to those within twice the median distance from it.
Eigen::Vector3d estimate_ground_normal(const std::vector<Eigen::Vector3d>& points,
                                       const Eigen::Vector2d& p_plan, double laser_z_m) {
  const std::vector<Eigen::Vector3d> low = low_points(points, p_plan, laser_z_m);
  std::vector<Eigen::Vector3d> inliers = low;
  Plane plane = fit_plane(inliers);
  for (int i = 0; i < kRefinements; ++i) {
    std::vector<double> distances;
    for (const auto& p : low) {
      distances.push_back(std::abs((p - plane.centroid).dot(plane.normal)));
    }
    const double limit = std::max(2.0 * median(distances), kNoiseM);
    inliers.clear();
    for (std::size_t k = 0; k < low.size(); ++k) {
      if (distances[k] <= limit) inliers.push_back(low[k]);
    }
    plane = fit_plane(inliers);
  }
  return plane.normal;
}

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
  throw std::invalid_argument(
      fmt::format("{} is not one of the axes x, y, z, -x, -y, -z", quote(up)));
}

Cloud place_cloud(const PointCloud& points, const CloudPlacement& placement) {
  Upright cloud = rotate_upright(points, placement);
  const Eigen::Vector2d p_plan = placement.p_plan_vehicle.value_or(cloud.laser.head<2>());
  if (placement.level) level(cloud, p_plan);
  const double ground_m = placement.ground_m
                              ? *placement.ground_m
                              : estimate_ground_height(cloud.points, p_plan, cloud.laser.z());
  if (cloud.laser.z() < ground_m + kLaserHeightMinM) {
    throw std::runtime_error(
        "the laser is not above the ground: see --laser-at, --ground-m and --up");
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
