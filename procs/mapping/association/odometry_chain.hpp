// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "common/pose_graph/pose_graph.hpp"

namespace adit {

/// A relative pose with its covariance.
struct UncertainPose {
  Pose2 T_from_to;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of (x, y, θ) in the frame of `to`
};

/// Composition to first order; both are independent.
UncertainPose operator*(const UncertainPose& a, const UncertainPose& b);
UncertainPose inverse(const UncertainPose& a);

/// The measurement of a constraint. Directions without information get a standard deviation of 30 m
/// or rad.
UncertainPose measured_by(const PoseConstraint& constraint);

/// The composed displacements between consecutive local maps, without loop closures: gives the
/// relative pose of any two maps in constant time, since the covariances of steps add up in the
/// frame of the first map.
class OdometryChain {
 public:
  /// Adds the next map by its displacement from the previous one; the first call is for map 0.
  void add_map(const UncertainPose& T_previous_map);
  /// Removes all maps but the first `maps`.
  void truncate(int maps) { nodes_.resize(static_cast<std::size_t>(maps)); }

  [[nodiscard]] UncertainPose between(int from, int to) const;
  /// Path length from the first map [m].
  [[nodiscard]] double length_m(int map) const { return at(map).length_m; }
  [[nodiscard]] int maps() const { return static_cast<int>(nodes_.size()); }
  /// Area of the rectangle, along the axes of the first map, around all maps [m²].
  [[nodiscard]] double area_m2() const;

 private:
  struct Node {
    Pose2 T_first_map;
    // Of T_first_map, in the frame of the first.
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    double length_m = 0.0;
  };

  [[nodiscard]] const Node& at(int map) const { return nodes_[static_cast<std::size_t>(map)]; }

  std::vector<Node> nodes_;
};

/// The probability that a residual with this covariance has a squared norm, normalised by it, below
/// `gate` by chance, if it is equally likely all over a map of this area [m²]; at most 1.
double chance_of_fit(const Eigen::Matrix3d& covariance, double gate, double area_m2);

/// The residual of a cycle of measurements.
struct CycleResidual {
  /// Squared and normalised: chi-square with three degrees of freedom if all measurements are
  /// correct.
  double disagreement = 0.0;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of (x, y, θ)
};

/// The cycle along the odometry and two loop closures.
CycleResidual cycle_residual(const OdometryChain& odometry, const PoseConstraint& a,
                             const PoseConstraint& b);

/// The cycle of one loop closure and the odometry.
CycleResidual cycle_residual(const OdometryChain& odometry, const PoseConstraint& loop_closure);

}  // namespace adit
