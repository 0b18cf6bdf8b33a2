// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace adit {

/// Heights as a plane: z = offset_m + grade · p.
struct HeightPlane {
  float offset_m = 0.0F;
  Eigen::Vector2f grade{0.0F, 0.0F};

  [[nodiscard]] float at(const Eigen::Vector2f& p) const { return offset_m + grade.dot(p); }
};

/// Sums of a least-squares fit of a plane.
class HeightPlaneFit {
 public:
  void add(const Eigen::Vector2f& p, float z_m);
  [[nodiscard]] std::size_t count() const { return count_; }

  /// The plane; needs a height. The grade is regularized as if the heights were those of a level
  /// plane as well, with points `spread_m` from their mean: less where they lie closer together.
  [[nodiscard]] HeightPlane plane(double spread_m) const;
  /// The same through a known height at the origin.
  [[nodiscard]] HeightPlane plane_through(float z_origin_m, double spread_m) const;

 private:
  std::size_t count_ = 0;
  Eigen::Vector2d sum_p_{0.0, 0.0};
  double sum_z_ = 0.0;
  Eigen::Matrix2d sum_pp_ = Eigen::Matrix2d::Zero();
  Eigen::Vector2d sum_pz_{0.0, 0.0};
};

}  // namespace adit
