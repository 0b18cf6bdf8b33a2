// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace adit {

/// A return for a comparison.
struct ComparedPoint {
  Eigen::Vector3f p{0.0F, 0.0F, 0.0F};  ///< in the frame of the comparison [m]
  std::uint32_t scan = 0;               ///< position in its list of scans
};

/// Number of the cube of side `voxel_m` that contains a point; unique within 10^6 cubes of the
/// origin.
inline std::uint64_t voxel_key(const Eigen::Vector3i& voxel) {
  constexpr std::uint64_t kMask = (std::uint64_t{1} << 21U) - 1U;
  const auto part = [](int i) { return static_cast<std::uint64_t>(i) & kMask; };
  return part(voxel.x()) | part(voxel.y()) << 21U | part(voxel.z()) << 42U;
}
inline Eigen::Vector3i voxel_of(const Eigen::Vector3d& p, double voxel_m) {
  return (p / voxel_m).array().floor().cast<int>().matrix();
}
inline std::uint64_t voxel_key(const Eigen::Vector3d& p, double voxel_m) {
  return voxel_key(voxel_of(p, voxel_m));
}

/// Points by cubes, to find those around a place or along a line.
class PointIndex {
 public:
  /// The order of points within a cube is that of `points`.
  PointIndex(std::vector<ComparedPoint> points, double cell_m);

  [[nodiscard]] const std::vector<ComparedPoint>& points() const { return points_; }

  /// Calls `visit` with each point within `radius_m` of the part of the line through p along the
  /// unit vector n that is at most `half_length_m` from p.
  template <class Visit>
  void for_each_along(const Eigen::Vector3d& p, const Eigen::Vector3d& n, double radius_m,
                      double half_length_m, Visit visit) const {
    const Eigen::Vector3d reach =
        half_length_m * n.cwiseAbs() + Eigen::Vector3d::Constant(radius_m);
    const double beside = radius_m + kHalfDiagonal * cell_m_;
    const double beyond = half_length_m + kHalfDiagonal * cell_m_;
    for_each_cell(p - reach, p + reach, [&](const Eigen::Vector3i& cell) {
      const Eigen::Vector3d centre =
          cell_m_ * (cell.cast<double>() + Eigen::Vector3d::Constant(0.5)) - p;
      const double along = centre.dot(n);
      if (std::abs(along) > beyond || centre.squaredNorm() - along * along > beside * beside)
        return;
      for_each_in(cell, [&](const ComparedPoint& point) {
        const Eigen::Vector3d d = point.p.cast<double>() - p;
        const double h = d.dot(n);
        if (std::abs(h) <= half_length_m && d.squaredNorm() - h * h <= radius_m * radius_m)
          visit(point, h);
      });
    });
  }

  /// Calls `visit` with each point within `radius_m` of p.
  template <class Visit>
  void for_each_around(const Eigen::Vector3d& p, double radius_m, Visit visit) const {
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(radius_m);
    for_each_cell(p - reach, p + reach, [&](const Eigen::Vector3i& cell) {
      for_each_in(cell, [&](const ComparedPoint& point) {
        if ((point.p.cast<double>() - p).squaredNorm() <= radius_m * radius_m) visit(point);
      });
    });
  }

 private:
  static constexpr double kHalfDiagonal = 0.8661;  // of a cube of side 1

  template <class Visit>
  void for_each_cell(const Eigen::Vector3d& low, const Eigen::Vector3d& high, Visit visit) const {
    const Eigen::Vector3i from = voxel_of(low, cell_m_);
    const Eigen::Vector3i to = voxel_of(high, cell_m_);
    for (int x = from.x(); x <= to.x(); ++x) {
      for (int y = from.y(); y <= to.y(); ++y) {
        for (int z = from.z(); z <= to.z(); ++z) visit(Eigen::Vector3i(x, y, z));
      }
    }
  }
  template <class Visit>
  void for_each_in(const Eigen::Vector3i& cell, Visit visit) const {
    const auto found = range_of_.find(voxel_key(cell));
    if (found == range_of_.end()) return;
    for (std::size_t i = found->second.first; i < found->second.second; ++i) visit(points_[i]);
  }

  double cell_m_;
  std::vector<ComparedPoint> points_;  // sorted by cube
  std::unordered_map<std::uint64_t, std::pair<std::size_t, std::size_t>> range_of_;
};

}  // namespace adit
