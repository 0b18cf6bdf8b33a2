// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"
#include "common/registration/surface_points.hpp"

namespace adit {

/// A small patch of a wall: the mean of all points measured on it.
struct Surfel {
  Eigen::Vector2d p = Eigen::Vector2d::Zero();  ///< [m]
  double z_m = 0.0;                             ///< mean height of the beams that hit it,
  double z_min_m = 0.0;                         ///< and their range
  double z_max_m = 0.0;
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();  ///< unit, towards the laser; zero: unknown
  double normal_variance = 0.0;                      ///< [rad²]
  double variance = 0.0;                             ///< of the position along the normal [m²]
  double last_observed = 0.0;                        ///< odometer at the last observation [m]
  int next = -1;                                     ///< next surfel of the same bucket

  [[nodiscard]] bool has_normal() const { return normal.squaredNorm() > 0.5; }
  /// Observed in one place at different heights: too steep for ground. A pose that follows the line
  /// in which beams meet a roof sees that in one place too, at heights that differ less.
  [[nodiscard]] bool is_steep() const { return z_max_m - z_min_m > kSteepM; }

  static constexpr double kSteepM = 0.3;
};

/// The result of a nearest-surfel query, and how long it stays valid.
struct NearestSurfel {
  const Surfel* surfel = nullptr;  ///< null: none within the radius
  double clearance = 0.0;  ///< if the point moves less than this [m], the result does not change
};

struct SurfelMapParams {
  double spacing_m = 0.05;  ///< closer points on the same side of a wall are merged
  double share_min = 0.05;  ///< minimum weight of a new point in the mean of a surfel
  template <class V>
  void visit(V& v) {
    v("spacing_m", spacing_m, within(0.005, 1.0));
    v("share_min", share_min, within(0.0, 1.0));
  }
};

/// The recently observed walls, as surfels in a grid of buckets that wraps around: fixed memory,
/// constant time per insertion and query, unbounded area. Coordinates are in the frame of the
/// caller.
class SurfelMap {
 public:
  /// Along each side of the grid, a power of two. Of the walls of one local map few are farther
  /// apart than 32 m; a grid of that size is made in a twentieth of the time.
  enum class Buckets : int { kOfOneLocalMap = 128, kOfSeveral = 512 };

  explicit SurfelMap(const SurfelMapParams& params, Buckets side = Buckets::kOfSeveral);

  /// Merges points, given in the body frame, at a pose. `odometer`: path length so far [m].
  void insert(const std::vector<SurfacePoint>& points_body, const Pose2& T_odom_body,
              double odometer);

  /// Removes surfels last observed before this odometer reading [m].
  void remove_before(double odometer);

  /// The surfel nearest to p within `radius` (at most kReach, two buckets) whose normal, if both
  /// are known, differs by less than 60°.
  [[nodiscard]] NearestSurfel nearest(const Eigen::Vector2d& p, const Eigen::Vector2d& normal,
                                      double radius) const;

  [[nodiscard]] const std::vector<Surfel>& surfels() const { return surfels_; }
  [[nodiscard]] bool empty() const { return surfels_.empty(); }
  void clear();

  static constexpr double kBucket = 0.25;          ///< side of a bucket [m]
  static constexpr double kReach = 2.0 * kBucket;  ///< maximum query radius [m]

 private:
  [[nodiscard]] int bucket(int ix, int iy) const {
    return ((iy & (side_ - 1)) * side_) + (ix & (side_ - 1));
  }

  void merge(const SurfacePoint& point, double odometer);
  void link(int surfel);

  SurfelMapParams params_;
  int side_;  ///< buckets; the grid repeats behind them
  std::vector<Surfel> surfels_;
  std::vector<std::int32_t> heads_;
};

}  // namespace adit
