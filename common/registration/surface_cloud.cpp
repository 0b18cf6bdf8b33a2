// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/registration/surface_cloud.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/geometry/symmetric_eigen.hpp"

namespace adit {
namespace {

constexpr int kVoxelsMin = 5;          // of a plane
constexpr double kFlatness = 0.1;      // maximum ratio of the smallest to the middle variance
constexpr double kSpread = 0.15;       // minimum ratio of the middle to the largest variance
constexpr double kNoiseSdM = 0.005;    // of the mean of a voxel, at least
constexpr double kAlignedCos = 0.707;  // 45 degrees

using Voxel = Eigen::Vector3i;

Voxel voxel_of(const Eigen::Vector3d& p, double voxel_m) {
  return (p / voxel_m).array().floor().cast<int>().matrix();
}

std::uint64_t key(const Voxel& voxel) {
  constexpr std::uint64_t kMask = (1U << 21U) - 1U;
  const auto part = [](int i) { return static_cast<std::uint64_t>(i) & kMask; };
  return part(voxel.x()) | part(voxel.y()) << 21U | part(voxel.z()) << 42U;
}

template <class Visit>
void for_each_around(const Voxel& voxel, Visit&& visit) {
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) visit(key(voxel + Voxel(x, y, z)));
    }
  }
}

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
    const Voxel at = voxel_of(centre, voxel_m);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    int count = 0;
    for_each_around(at, [&](std::uint64_t around) {
      const auto found = voxel_at.find(around);
      if (found == voxel_at.end()) return;
      const Eigen::Vector3d p = voxels[static_cast<std::size_t>(found->second)].mean() - centre;
      sum += p;
      squares += p * p.transpose();
      ++count;
    });
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
  }
}

const SurfacePatch* SurfaceCloud::nearest(const Eigen::Vector3d& p,
                                          const Eigen::Vector3d& normal) const {
  const SurfacePatch* nearest = nullptr;
  double nearest_m2 = std::numeric_limits<double>::infinity();
  for_each_around(voxel_of(p, voxel_m_), [&](std::uint64_t around) {
    const auto found = patch_at_.find(around);
    if (found == patch_at_.end()) return;
    const SurfacePatch& patch = patches_[static_cast<std::size_t>(found->second)];
    const double distance_m2 = (patch.p - p).squaredNorm();
    if (distance_m2 >= nearest_m2 || patch.normal.dot(normal) < kAlignedCos) return;
    nearest = &patch;
    nearest_m2 = distance_m2;
  });
  return nearest;
}

}  // namespace adit
