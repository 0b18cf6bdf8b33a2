// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/types/planned_path.hpp"

namespace adit {

/// Cross-track error of the true body origin: the lateral distance from the polyline of a path. The
/// search is independent of driving. Positions must be passed in the order of the drive.
class CrossTrackError {
 public:
  explicit CrossTrackError(const std::vector<PathPoint>& points);

  /// Signed distance [m], positive to the left of the direction of travel. Searches only near the
  /// previous projection.
  double operator()(const Eigen::Vector2d& p_odom);

 private:
  std::vector<Eigen::Vector2d> positions_;
  std::vector<double> path_lengths_m_;
  double s_m_ = 0.0;
};

}  // namespace adit
