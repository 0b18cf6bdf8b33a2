// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "procs/planning/passage/wall_distance.hpp"

namespace adit {

using Polyline = std::vector<Eigen::Vector2d>;

/// An elastic band (Quinlan and Khatib, "Elastic bands: connecting path planning and control",
/// 1993): points 0.1 m apart in level, which walls on both sides push to where the body has the
/// same width free on either side, and which stiffness keeps from bending. The first two points
/// keep the place and the heading of the robot.
class ElasticBand {
 public:
  /// `T_level_leading` is the pose of the robot, turned by π if the rear leads.
  ElasticBand(const Polyline& guide, const Pose2& T_level_leading, const WallDistance& walls);

  /// Bends the band; `stiffness` is that of curvature. At 2 it bends over a metre.
  void relax(double stiffness);

  [[nodiscard]] std::size_t size() const { return line_.size(); }
  /// The pose of the body at a point, with its heading along the band.
  [[nodiscard]] Pose2 pose_at(std::size_t i) const;
  [[nodiscard]] double curvature_1_m(std::size_t i) const;
  /// Length of the band up to each of its points [m].
  [[nodiscard]] std::vector<double> lengths_m() const;

 private:
  /// A linear least squares problem in the displacements of all points along their normals.
  struct NormalEquations;

  [[nodiscard]] double shift(double stiffness);
  [[nodiscard]] NormalEquations normal_equations(double stiffness) const;
  void hold_start();

  const WallDistance& walls_;
  Pose2 T_level_leading_;
  Polyline line_;
};

}  // namespace adit
