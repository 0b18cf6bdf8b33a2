// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/memory/height_alignment.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "common/types/body_outline.hpp"

namespace adit {
namespace {

constexpr int kStride = 2;                   // stride of the compared cells, along rows and columns
constexpr std::size_t kDifferencesMin = 60;  // minimum for an alignment
constexpr float kCoarseInlierM =
    0.15F;  // distance from the median up to which the first fit uses them [m]
constexpr double kTiltSpread = 1.0;  // regularization of the tilt, as the spread of the points [m]
constexpr double kBodySpread = 0.1;  // the same for the grade of the ground under the body
constexpr double kSamePlace = 0.1;   // distance of two scans from the same place [m]
constexpr int kDisappearedMin = 15;

struct Difference {
  Eigen::Vector2f p_level;
  float dz;
};

HeightPlane fit(const std::vector<Difference>& differences) {
  HeightPlaneFit sums;
  for (const Difference& d : differences) sums.add(d.p_level, d.dz);
  return sums.plane(kTiltSpread);
}

std::vector<Difference> inliers(const std::vector<Difference>& all, const HeightPlane& plane,
                                float residual_m) {
  std::vector<Difference> coarse_inliers;
  std::copy_if(
      all.begin(), all.end(), std::back_inserter(coarse_inliers),
      [&](const Difference& d) { return std::abs(d.dz - plane.at(d.p_level)) <= residual_m; });
  return coarse_inliers;
}

float median(std::vector<Difference> all) {
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end(),
                   [](const Difference& a, const Difference& b) { return a.dz < b.dz; });
  return middle->dz;
}

/// Compares a terrain map with a remembered one.
class Comparison {
 public:
  Comparison(const TerrainMap& now, const RememberedMap& before, const Vehicle& vehicle)
      : now_(now),
        obstacle_m_(obstacle_height_m(vehicle)),
        high_m_(static_cast<float>(vehicle.belly_clearance_m)),
        outline_(body_outline(vehicle)),
        T_before_now_(motion_of(between(before.T_odom_level(), now.T_odom_level))) {
    for (int row = 0; row < now.cells.rows(); row += kStride) {
      for (int column = 0; column < now.cells.columns(); column += kStride) {
        const Eigen::Vector2d p_now = now.centre(column, row);
        const Eigen::Vector2d p_before = T_before_now_ * p_now;
        const auto* cell =
            before.at(static_cast<float>(p_before.x()), static_cast<float>(p_before.y()));
        if (cell != nullptr) compare(column, row, p_now, p_before, *cell);
      }
    }
    compare_with_body(under_body_before_, 1.0F);
    compare_with_body(under_body_now_, -1.0F);
  }

  [[nodiscard]] const std::vector<Difference>& differences() const { return differences_; }
  [[nodiscard]] bool same_place() const { return T_before_now_.translation().norm() < kSamePlace; }
  [[nodiscard]] bool obstacles_disappeared(double share_max) const {
    return disappeared_ >= kDisappearedMin &&
           disappeared_ > share_max * (disappeared_ + persisted_);
  }

 private:
  void compare(int column, int row, const Eigen::Vector2d& p_now, const Eigen::Vector2d& p_before,
               const RememberedCell& before) {
    const TerrainCell& now = now_.cells.at({column, row});
    const bool observed_now = now.ground == Ground::kObserved && now.count > 0;
    const bool observed_before = before.ground == Ground::kObserved && before.count > 0;
    const bool even_now = observed_now && now.high_m - now.low_m <= obstacle_m_;
    const bool even_before = observed_before && before.high_m - before.low_m <= obstacle_m_;
    const Eigen::Vector2f p = p_now.cast<float>();
    if (even_now && even_before) {
      differences_.push_back({p, now.low_m - before.low_m});
    } else if (even_now && is_below_body(p_before)) {
      under_body_before_.push_back({p, p_before.cast<float>(), now.low_m});
    } else if (even_before && is_below_body(p_now)) {
      under_body_now_.push_back({p, p, before.low_m});
    }
    if (!observed_now || !is_obstacle(before, high_m_)) return;
    ++(obstacle_near(column, row) ? persisted_ : disappeared_);
  }

  /// Ground that one scan observed where the body stood at the other.
  struct BodyGround {
    Eigen::Vector2f p_level;  ///< of the new scan
    Eigen::Vector2f p_body;
    float z_m;
  };

  /// The ground under the origin of the body has height 0. That around it may slope: its own plane
  /// moves the heights to the origin.
  void compare_with_body(const std::vector<BodyGround>& ground, float sign) {
    if (ground.empty()) return;
    HeightPlaneFit sums;
    for (const BodyGround& at : ground) sums.add(at.p_body, at.z_m);
    const Eigen::Vector2f grade = sums.plane(kBodySpread).grade;
    for (const BodyGround& at : ground) {
      differences_.push_back({at.p_level, sign * (at.z_m - grade.dot(at.p_body))});
    }
  }

  [[nodiscard]] bool is_below_body(const Eigen::Vector2d& p_body) const {
    return outline_.contains(p_body);
  }

  [[nodiscard]] bool obstacle_near(int column, int row) const {
    for (int r = row - 1; r <= row + 1; ++r) {
      for (int c = column - 1; c <= column + 1; ++c) {
        if (now_.cells.contains({c, r}) && is_obstacle(now_.cells.at({c, r}), obstacle_m_))
          return true;
      }
    }
    return false;
  }

  const TerrainMap& now_;
  float obstacle_m_;
  float high_m_;  ///< height of obstacles that are never taken for ground from another viewpoint
  ConvexPolygon outline_;
  Eigen::Isometry2d T_before_now_;
  std::vector<Difference> differences_;
  std::vector<BodyGround> under_body_before_;
  std::vector<BodyGround> under_body_now_;
  int disappeared_ = 0;
  int persisted_ = 0;
};

}  // namespace

std::optional<HeightPlane> align_heights(const TerrainMap& now, const RememberedMap& before,
                                         const TerrainParams& params) {
  const Comparison comparison(now, before, params.vehicle);
  const std::vector<Difference>& all = comparison.differences();
  if (comparison.obstacles_disappeared(params.memory.disappeared_share_max)) return std::nullopt;
  if (all.size() < kDifferencesMin) {
    return comparison.same_place() ? std::optional(HeightPlane{}) : std::nullopt;
  }
  const auto residual_m = static_cast<float>(params.memory.residual_max_m);
  const auto coarse_inliers = inliers(all, {median(all)}, kCoarseInlierM);
  const auto fine_inliers = inliers(all, fit(coarse_inliers), residual_m);
  if (static_cast<double>(fine_inliers.size()) <
      params.memory.inlier_share * static_cast<double>(all.size())) {
    return std::nullopt;
  }
  const HeightPlane plane = fit(fine_inliers);
  if (plane.grade.norm() > params.memory.tilt_max) return std::nullopt;
  return plane;
}

}  // namespace adit
