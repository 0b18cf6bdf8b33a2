// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "common/pose_graph/pose_graph.hpp"

namespace adit {

/// A constraint between local maps, and its origin.
struct MapConstraint {
  enum class Kind : std::int8_t {
    kSequential = 0,   ///< between consecutive local maps
    kLoopClosure = 1,  ///< between local maps of one place
  };

  PoseConstraint measured;
  Kind kind = Kind::kSequential;
};

/// The pose graph published by mapping: all local maps, and the constraints in force.
struct MapGraph {
  std::int64_t utime = 0;     ///< of the newest measurement in it [µs since the epoch]
  std::int64_t revision = 0;  ///< incremented with each change
  std::vector<Pose2> poses;   ///< T_map_local, by the id of the local map
  std::vector<MapConstraint> constraints;
  /// Heights of the local maps above the first one [m], and their variances [m²]; as many as poses.
  std::vector<double> z_m = {};
  std::vector<double> z_variance = {};
};

/// The poses and measurements alone.
inline PoseGraph pose_graph_of(const MapGraph& graph) {
  PoseGraph plain{graph.poses, {}};
  for (const MapConstraint& constraint : graph.constraints) {
    plain.constraints.push_back(constraint.measured);
  }
  return plain;
}

}  // namespace adit
