// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/scores/stored_map_score.hpp"

#include <algorithm>

namespace adit::test {

MapGraph restore_graph(const StoredMap& stored) {
  Mapping mapping(MappingParams{});
  mapping.restore({stored.maps, stored.associations, {}});
  return mapping.graph();
}

PathError error_of(const StoredMap& stored, const MapGraph& graph, const Trajectory& truth) {
  Trajectory trajectory;
  for (const LocalMap& map : stored.maps) {
    trajectory.push_back({map.utime, graph.poses[static_cast<std::size_t>(map.id)]});
  }
  return path_error(trajectory, truth);
}

int loop_closures_between_sessions(const StoredMap& stored, const MapGraph& graph) {
  const auto session = [&](int map) { return stored.maps[static_cast<std::size_t>(map)].session; };
  return static_cast<int>(std::ranges::count_if(graph.constraints, [&](const MapConstraint& c) {
    return c.kind == MapConstraint::Kind::kLoopClosure &&
           session(c.measured.from) != session(c.measured.to);
  }));
}

}  // namespace adit::test
