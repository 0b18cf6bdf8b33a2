// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "common/pose_graph/pose_graph.hpp"

namespace adit {

/// A relative pose and how well it is known.
struct UncertainPose {
  Pose2 T_from_to;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of (x, y, θ) in the frame of `to`
};

/// The composition, to first order; both independent.
UncertainPose operator*(const UncertainPose& a, const UncertainPose& b);
UncertainPose inverse(const UncertainPose& a);

/// What a constraint measured. Directions of which it knows nothing get an uncertainty of 30 m or
/// rad.
UncertainPose measured_by(const PoseConstraint& constraint);

/// The chain of displacements between local maps alone, whatever closures say: the relative pose of
/// any two in constant time, since steps add up in the frame of the first.
class OdometryChain {
 public:
  /// The next map, by its displacement from the one before; the first call is for map 0.
  void add_map(const UncertainPose& T_previous_map);
  /// All but the first so many maps are forgotten.
  void truncate(int maps) { nodes_.resize(static_cast<std::size_t>(maps)); }

  [[nodiscard]] UncertainPose between(int from, int to) const;
  /// Path length from the first map [m].
  [[nodiscard]] double length_m(int map) const { return at(map).length_m; }
  [[nodiscard]] int maps() const { return static_cast<int>(nodes_.size()); }

 private:
  struct Node {
    Pose2 T_first_map;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // of it, in the frame of the first
    double length_m = 0.0;
  };

  [[nodiscard]] const Node& at(int map) const { return nodes_[static_cast<std::size_t>(map)]; }

  std::vector<Node> nodes_;
};

/// What is left when one goes around by the way and two closures, squared and normalised:
/// chi-square with three degrees of freedom where both are right.
double disagreement(const OdometryChain& odometry, const PoseConstraint& a,
                    const PoseConstraint& b);

/// The same for one closure and the way.
double disagreement(const OdometryChain& odometry, const PoseConstraint& loop_closure);

}  // namespace adit
