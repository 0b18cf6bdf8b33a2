// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "common/geometry/pose2.hpp"
#include "procs/mapping/mapping.hpp"
#include "tools/eval/relations.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {

/// Precision and recall of the accepted loop closures, by relations.
///
/// A relation links two local maps if it has one time in each and they are not neighbours in the
/// chain. Each such relation gives a pose of the newer map in the older one. Relations with a time
/// between scans while the body moved are ignored, since the interpolated pose is inaccurate.
struct LoopClosureScore {
  std::size_t accepted = 0;
  std::size_t evaluated = 0;  ///< accepted loop closures of linked maps
  std::size_t right = 0;      ///< of these, within 0.5 m and 5° of at least half of the relations
  std::size_t expected = 0;   ///< pairs of maps linked by a relation of at most 5 m
  std::size_t found = 0;  ///< of these, with an accepted loop closure between them or neighbours

  [[nodiscard]] double precision() const { return share(right, evaluated); }
  [[nodiscard]] double recall() const { return share(found, expected); }

 private:
  static double share(std::size_t count, std::size_t total) {
    return total == 0 ? 0.0 : static_cast<double>(count) / static_cast<double>(total);
  }
};

/// `odometry` is the input of the map: T_odom_body of one session.
LoopClosureScore score_loop_closures(const StoredMap& map, const Trajectory& odometry,
                                     const std::vector<Relation>& relations);

}  // namespace adit
