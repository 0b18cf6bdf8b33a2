// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "common/pose_graph/height_field.hpp"

namespace adit {

/// The constant error of the attitude of a session, as that of the accelerometer's bias and of the
/// mount: rotations about x and y of the body by which the level frames of its 3D scans are
/// inclined. One heading does not show it, since all level frames are inclined alike. Between two
/// scans whose headings differ by θ the surfaces show the relative tilt −(I − R(−θ)) e.
class LevelError {
 public:
  /// `prior_sd_rad`: of both components.
  explicit LevelError(double prior_sd_rad);

  /// Adds a match of two 3D scans: the turn from the older to the newer one, and the rotation
  /// vector about x and y of the newer one that remains without the turn, with its covariance [rad,
  /// rad²]. A tilt that the error cannot explain is a wrong match and ignored.
  void add(double turn_rad, const Eigen::Vector2d& tilt_rad, const Eigen::Matrix2d& covariance);

  /// Roll and pitch, as stated less true [rad].
  [[nodiscard]] Eigen::Vector2d error_rad() const;
  [[nodiscard]] Eigen::Matrix2d covariance() const { return information_.inverse(); }
  /// The same as what it adds to heights.
  [[nodiscard]] TiltPrior as_prior() const;

 private:
  Eigen::Matrix2d information_;
  Eigen::Vector2d vector_ = Eigen::Vector2d::Zero();
};

}  // namespace adit
