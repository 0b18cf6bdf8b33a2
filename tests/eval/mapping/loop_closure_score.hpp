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

/// Which closures are in force, against relations.
///
/// Two local maps are linked where a relation has one time in each and they are not neighbours in
/// the chain. Each such relation gives a pose of the newer map in the older one; relations whose
/// times fall between scans while the body moved are left out, as they give a wrong one.
struct LoopClosureScore {
  std::size_t in_force = 0;
  std::size_t evaluated = 0;  ///< of maps that relations link
  std::size_t right = 0;  ///< of these, those within 0.5 m and 5° of half of the relations or more
  std::size_t expected =
      0;                  ///< pairs of maps that relations link, with 5 m at most between the poses
  std::size_t found = 0;  ///< of these, those with a closure in force between them or neighbours

  [[nodiscard]] double precision() const { return share(right, evaluated); }
  [[nodiscard]] double recall() const { return share(found, expected); }

 private:
  static double share(std::size_t count, std::size_t total) {
    return total == 0 ? 0.0 : static_cast<double>(count) / static_cast<double>(total);
  }
};

/// `odometry` is that of which the map was made: T_odom_body, one session.
LoopClosureScore score_loop_closures(const StoredMap& map, const Trajectory& odometry,
                                     const std::vector<Relation>& relations);

}  // namespace adit
