// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include <Eigen/Core>

#include "common/types/cloud.hpp"

namespace adit {

/// A small part of a surface of a 3D scan, in its frame level [m].
struct SurfacePatch {
  Eigen::Vector3d p;       ///< mean of the points of a voxel
  Eigen::Vector3d normal;  ///< unit vector, towards the laser
  double sd_m = 0.0;       ///< of the voxels around, from their plane
  /// Variance of the normal in each direction across it [rad²].
  double normal_variance = 0.0;
};

/// The returns in a voxel of a 3D scan, in its frame level [m].
struct ThinnedPoint {
  Eigen::Vector3d p;       ///< mean
  Eigen::Vector3d origin;  ///< of the laser at the first of them
};

/// The surfaces of a 3D scan: its points thinned to one per voxel, with normals from the voxels
/// around. Deterministic: points and patches are in the order of the lines.
class SurfaceCloud {
 public:
  /// Points farther than `range_max_m` from the laser are left out. Patches are placed on
  /// `voxel_m`, normals follow from 3 × 3 × 3 voxels; where these do not lie on a plane there is no
  /// patch.
  SurfaceCloud(const Cloud& cloud, double voxel_m, double range_max_m);

  [[nodiscard]] const std::vector<SurfacePatch>& patches() const { return patches_; }
  /// Those far away are too sparse for patches.
  [[nodiscard]] const std::vector<ThinnedPoint>& points() const { return points_; }
  [[nodiscard]] double voxel_m() const { return voxel_m_; }

  /// The patch nearest to a point of those in the voxels around it that a laser at `origin` sees
  /// from their front; nullptr without one.
  [[nodiscard]] const SurfacePatch* nearest(const Eigen::Vector3d& p,
                                            const Eigen::Vector3d& origin) const;

 private:
  double voxel_m_;
  std::vector<ThinnedPoint> points_;
  std::vector<SurfacePatch> patches_;
  std::unordered_map<std::uint64_t, int> patch_at_;  ///< by voxel
  /// Of voxels, those with a patch in them or beside them: most points of another scan are far from
  /// all patches.
  std::unordered_set<std::uint64_t> blocks_;
};

}  // namespace adit
