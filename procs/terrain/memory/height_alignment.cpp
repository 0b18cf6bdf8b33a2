// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/memory/height_alignment.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "common/geometry/symmetric_solve.hpp"

namespace adit {
namespace {

constexpr int kStride = 2;                   // stride of the compared cells, along rows and columns
constexpr std::size_t kDifferencesMin = 60;  // minimum for an alignment
constexpr float kCoarseInlierM =
    0.15F;  // distance from the median up to which the first fit uses them [m]
constexpr float kTiltSpread = 1.0F;  // regularization of the tilt, as the spread of the points [m]
constexpr double kSamePlace = 0.1;   // distance of two scans from the same place [m]
constexpr int kDisappearedMin = 15;

struct Difference {
  Eigen::Vector2f p_level;
  float dz;
};

/// Least squares with a regularized grade, for points that lie close together.
HeightPlane fit(const std::vector<Difference>& differences) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& d : differences) mean += Eigen::Vector3d(d.p_level.x(), d.p_level.y(), d.dz);
  mean /= static_cast<double>(differences.size());
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (const auto& d : differences) {
    const Eigen::Vector2d p = d.p_level.cast<double>() - mean.head<2>();
    spread += p * p.transpose();
    moment += p * (d.dz - mean.z());
  }
  spread.diagonal().array() += kTiltSpread * kTiltSpread * static_cast<double>(differences.size());
  const Eigen::Vector2d grade = solve_symmetric(spread, moment);
  return {static_cast<float>(mean.z() - grade.dot(mean.head<2>())), grade.cast<float>()};
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
        half_(vehicle.length_m / 2.0, vehicle.width_m / 2.0),
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
      differences_.push_back({p, now.low_m});
    } else if (even_before && is_below_body(p_now)) {
      differences_.push_back({p, -before.low_m});
    }
    if (!observed_now || !is_obstacle(before, high_m_)) return;
    ++(obstacle_near(column, row) ? persisted_ : disappeared_);
  }

  [[nodiscard]] bool is_below_body(const Eigen::Vector2d& p_body) const {
    return (p_body.array().abs() <= half_.array()).all();
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
  Eigen::Vector2d half_;
  Eigen::Isometry2d T_before_now_;
  std::vector<Difference> differences_;
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
