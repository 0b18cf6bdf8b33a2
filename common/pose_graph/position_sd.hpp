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

}  // namespace adit
