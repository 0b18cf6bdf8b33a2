// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/plan/ground_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include <Eigen/Eigenvalues>

namespace adit {
namespace {

constexpr double kReachM = 5.0;
constexpr double kCellM = 0.25;
constexpr double kBelowLaserM = 0.1;
constexpr std::size_t kRank = 3;      // of the height in a cell: stray points below do not count
constexpr std::size_t kNearest = 60;  // cells
constexpr std::size_t kLeast = 10;    // cells
constexpr int kRefinements = 20;
constexpr double kNoiseM = 0.01;

/// The low points of cells, the nearest first.
std::vector<Eigen::Vector3d> low_points(const std::vector<Eigen::Vector3d>& points,
                                        const Eigen::Vector2d& p_plan, double laser_z_m) {
  std::map<std::pair<int, int>, std::vector<Eigen::Vector3d>> lowest;
  const auto is_lower = [](const auto& a, const auto& b) { return a.z() < b.z(); };
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector2d d = p.head<2>() - p_plan;
    if (p.z() > laser_z_m - kBelowLaserM || d.norm() > kReachM) continue;
    auto& cell = lowest[{static_cast<int>(std::floor(d.x() / kCellM)),
                         static_cast<int>(std::floor(d.y() / kCellM))}];
    cell.insert(std::upper_bound(cell.begin(), cell.end(), p, is_lower), p);
    if (cell.size() > kRank) cell.pop_back();
  }
  std::vector<Eigen::Vector3d> low;
  for (const auto& [place, cell] : lowest) low.push_back(cell.back());
  std::stable_sort(low.begin(), low.end(), [&](const auto& a, const auto& b) {
    return (a.template head<2>() - p_plan).norm() < (b.template head<2>() - p_plan).norm();
  });
  if (low.size() < kLeast) {
    throw std::runtime_error("the ground near the vehicle is not seen: see --ground and --origin");
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
  Eigen::Vector3d middle;
  Eigen::Vector3d normal;
};

Plane fitted(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const auto& p : points) middle += p / static_cast<double>(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const auto& p : points) spread += (p - middle) * (p - middle).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  const Eigen::Vector3d normal = axes.eigenvectors().col(0);
  return {middle, normal.z() < 0.0 ? Eigen::Vector3d(-normal) : normal};
}

}  // namespace

double estimate_ground_height(const std::vector<Eigen::Vector3d>& points,
                              const Eigen::Vector2d& p_plan, double laser_z_m) {
  std::vector<Eigen::Vector3d> low = low_points(points, p_plan, laser_z_m);
  low.resize(std::min(low.size(), kNearest));
  return median_height(std::move(low));
}

/// From all cells on, less those that are farther from the plane than most.
Eigen::Vector3d estimate_ground_normal(const std::vector<Eigen::Vector3d>& points,
                                       const Eigen::Vector2d& p_plan, double laser_z_m) {
  const std::vector<Eigen::Vector3d> low = low_points(points, p_plan, laser_z_m);
  std::vector<Eigen::Vector3d> used = low;
  Plane plane = fitted(used);
  for (int i = 0; i < kRefinements; ++i) {
    std::vector<double> off;
    for (const auto& p : low) off.push_back(std::abs((p - plane.middle).dot(plane.normal)));
    std::vector<double> sorted = off;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const double limit = std::max(2.0 * *middle, kNoiseM);
    used.clear();
    for (std::size_t k = 0; k < low.size(); ++k) {
      if (off[k] <= limit) used.push_back(low[k]);
    }
    plane = fitted(used);
  }
  return plane.normal;
}

}  // namespace adit
