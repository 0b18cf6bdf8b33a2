// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/types/planned_path.hpp"

namespace adit {

/// How far the body's origin truly is beside a path, by a search of its own along the line between
/// the points. To be asked in the order of the drive.
class CrossTrackError {
 public:
  explicit CrossTrackError(const std::vector<PathPoint>& points);

  /// To the left of the line, looking along the way; among places near to the last.
  double operator()(const Eigen::Vector2d& p_odom);

 private:
  std::vector<Eigen::Vector2d> positions_;
  std::vector<double> path_lengths_m_;
  double s_m_ = 0.0;
};

}  // namespace adit
