// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "common/grid/grid2.hpp"

namespace adit {

/// The grade of the ground around each cell, without its steps: heights are compared along it, so
/// that a slope is not taken for an obstacle. Along each axis it is a quantile of the grades
/// between points half a metre apart, within a metre of a node; nodes are a metre apart and
/// interpolated between. Of the quantiles around the median, that of the least magnitude counts: a
/// step, which fewer than a third of the pairs straddle, and noise on level ground give no grade.
/// At most kGradeMax, more than vehicles climb. Zero more than two metres from ground with enough
/// heights.
class GroundTrend {
 public:
  static constexpr float kGradeMax = 0.4F;

  GroundTrend() = default;
  /// `heights_m`: of cells of `cell_m` from (0, 0); not finite where unknown.
  GroundTrend(const Grid2<float>& heights_m, double cell_m);

  /// Rise from a cell to the next column and to the next row [m].
  [[nodiscard]] const Eigen::Vector2f& rise_m(std::size_t cell) const { return rise_m_[cell]; }
  [[nodiscard]] const Eigen::Vector2f& rise_m(int column, int row) const {
    return rise_m_.at({column, row});
  }

 private:
  Grid2<Eigen::Vector2f> rise_m_;
};

}  // namespace adit
