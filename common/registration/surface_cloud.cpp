// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/registration/surface_cloud.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/geometry/symmetric_eigen.hpp"

namespace adit {
namespace {

constexpr int kVoxelsMin = 7;        // of a plane
constexpr double kFlatness = 0.1;    // maximum ratio of the smallest to the middle variance
constexpr double kSpread = 0.15;     // minimum ratio of the middle to the largest variance
constexpr double kNoiseSdM = 0.005;  // of the mean of a voxel, at least

using Voxel = Eigen::Vector3i;

Voxel voxel_of(const Eigen::Vector3d& p, double voxel_m) {
  return (p / voxel_m).array().floor().cast<int>().matrix();
}

/// The block of 8 x 8 x 8 voxels.
Voxel block_of(const Voxel& voxel) { return {voxel.x() >> 3, voxel.y() >> 3, voxel.z() >> 3}; }

std::uint64_t key(const Voxel& voxel) {
  constexpr std::uint64_t kMask = (1U << 21U) - 1U;
  const auto part = [](int i) { return static_cast<std::uint64_t>(i) & kMask; };
  return part(voxel.x()) | part(voxel.y()) << 21U | part(voxel.z()) << 42U;
}

/// The steps from a voxel to those around it, itself first, then by their distance.
std::vector<Voxel> steps_around() {
  std::vector<Voxel> steps;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) steps.emplace_back(x, y, z);
    }
  }
  std::ranges::stable_sort(steps, {}, [](const Voxel& step) { return step.squaredNorm(); });
  return steps;
}

const std::vector<Voxel> kNearestFirst = steps_around();

struct VoxelPoints {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< of the laser at the first point
  int count = 0;

  [[nodiscard]] Eigen::Vector3d mean() const { return sum / count; }
};

}  // namespace

SurfaceCloud::SurfaceCloud(const Cloud& cloud, double voxel_m, double range_max_m)
    : voxel_m_(voxel_m) {
  std::vector<VoxelPoints> voxels;
  std::unordered_map<std::uint64_t, int> voxel_at;
  for (const CloudLine& line : cloud.lines) {
    const Eigen::Vector3d origin = line.origin.cast<double>();
    for (const Eigen::Vector3f& point : line.points) {
      const Eigen::Vector3d p = point.cast<double>();
      if ((p - origin).squaredNorm() > range_max_m * range_max_m) continue;
      const auto [entry, is_new] =
          voxel_at.try_emplace(key(voxel_of(p, voxel_m)), static_cast<int>(voxels.size()));
      if (is_new) voxels.emplace_back();
      VoxelPoints& voxel = voxels[static_cast<std::size_t>(entry->second)];
      if (is_new) voxel.origin = origin;
      voxel.sum += p;
      ++voxel.count;
    }
  }
  for (const VoxelPoints& voxel : voxels) {
    const Eigen::Vector3d centre = voxel.mean();
    points_.push_back({centre, voxel.origin});
    const Voxel at = voxel_of(centre, voxel_m);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    int count = 0;
    for (const Voxel& step : kNearestFirst) {
      const auto found = voxel_at.find(key(at + step));
      if (found == voxel_at.end()) continue;
      const Eigen::Vector3d p = voxels[static_cast<std::size_t>(found->second)].mean() - centre;
      sum += p;
      squares += p * p.transpose();
      ++count;
    }
    if (count < kVoxelsMin) continue;
    const Eigen::Vector3d mean = sum / count;
    const SymmetricEigen<3> principal =
        symmetric_eigen(Eigen::Matrix3d(squares / count - mean * mean.transpose()));
    const Eigen::Vector3d& variances = principal.values;  // increasing
    if (variances[1] < kSpread * variances[2] || variances[0] > kFlatness * variances[1]) continue;
    SurfacePatch patch;
    patch.normal = principal.vectors.col(0);
    // On the plane of the voxels around: the mean of few points of one voxel has more noise.
    patch.p = centre + patch.normal * patch.normal.dot(mean);
    if (patch.normal.dot(voxel.origin - patch.p) < 0.0) patch.normal = -patch.normal;
    const double variance = std::max(variances[0], kNoiseSdM * kNoiseSdM);
    patch.sd_m = std::sqrt(variance);
    patch.normal_variance = variance / (count * variances[1]);
    patch_at_.emplace(key(at), static_cast<int>(patches_.size()));
    patches_.push_back(patch);
    for (const Voxel& step : kNearestFirst) blocks_.insert(key(block_of(at + step)));
  }
}

const SurfacePatch* SurfaceCloud::nearest(const Eigen::Vector3d& p,
                                          const Eigen::Vector3d& origin) const {
  const SurfacePatch* nearest = nullptr;
  double nearest_m2 = std::numeric_limits<double>::infinity();
  const Voxel at = voxel_of(p, voxel_m_);
  if (!blocks_.contains(key(block_of(at)))) return nullptr;
  // Distances from p to the voxels below and above its own, along each axis.
  const Eigen::Array3d below = (p - at.cast<double>() * voxel_m_).array();
  const Eigen::Array3d above = voxel_m_ - below;
  for (const Voxel& step : kNearestFirst) {
    const Eigen::Array3d gap =
        (step.array() < 0).select(below, (step.array() > 0).select(above, Eigen::Array3d::Zero()));
    if (gap.matrix().squaredNorm() >= nearest_m2) continue;
    const auto found = patch_at_.find(key(at + step));
    if (found == patch_at_.end()) continue;
    const SurfacePatch& patch = patches_[static_cast<std::size_t>(found->second)];
    const double distance_m2 = (patch.p - p).squaredNorm();
    if (distance_m2 >= nearest_m2 || patch.normal.dot(origin - patch.p) <= 0.0) continue;
    nearest = &patch;
    nearest_m2 = distance_m2;
  }
  return nearest;
}

}  // namespace adit
