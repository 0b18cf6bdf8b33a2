// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Eigenvalues>

#include "common/pose_graph/map_correction.hpp"

namespace adit {

/// Standard deviation of the position of the local map of a correction, in the direction in which
/// it is greatest [m]; nothing where that is not known.
inline std::optional<double> position_sd_m(const MapCorrection& correction) {
  if (!correction.covariance) return std::nullopt;
  const Eigen::Matrix2d covariance = correction.covariance->topLeftCorner<2, 2>();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, axes.eigenvalues().maxCoeff()));
}

/// Whether odom is known on the map well enough to carry over into it what was seen in another
/// odom, by a cell and a half of the terrain and 3°. In the first session there is no doubt.
inline bool says_where_odom_is(const MapCorrection& correction) {
  constexpr double kSdMaxM = 0.15;
  constexpr double kSdMaxRad = 0.05;
  if (!correction.covariance) return true;
  const double sd_rad = std::sqrt(std::max(0.0, (*correction.covariance)(2, 2)));
  return *position_sd_m(correction) < kSdMaxM && sd_rad < kSdMaxRad;
}

}  // namespace adit
