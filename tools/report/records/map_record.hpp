// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/pose_graph/map_graph.hpp"
#include "common/types/association.hpp"
#include "common/types/local_map.hpp"
#include "common/types/map_contradictions.hpp"
#include "tools/eval/trajectory.hpp"
#include "tools/map/run_record.hpp"
#include "tools/report/records/thinned_trajectory.hpp"

namespace adit {

/// Collects the output of mapping, POSE and TRUTH. Poses are thinned to one per 0.05 m, 0.02 rad or
/// second, so that a log of several hours fits into memory.
class MapRecord {
 public:
  /// `bus` must outlive this.
  explicit MapRecord(Bus& bus);

  /// The newest map of each id, in order of ids. Leaves none.
  [[nodiscard]] std::vector<LocalMap> release_local_maps();
  [[nodiscard]] const std::map<int, LocalMap>& local_maps() const { return local_maps_; }
  /// Without duplicates, which mapping publishes after a restart.
  [[nodiscard]] const std::vector<Association>& associations() const { return associations_; }
  /// Last POSE_GRAPH.
  [[nodiscard]] const std::optional<MapGraph>& graph() const { return graph_; }
  /// Local maps that contradict each other at the end.
  [[nodiscard]] const std::vector<MapContradiction>& contradictions() const {
    return contradictions_;
  }

  /// T_odom_body, thinned. The odom frame may change after a restart of scan_matching.
  [[nodiscard]] const Trajectory& odometry() const { return odometry_.poses(); }
  /// T_world_body of the simulator, thinned; empty for a real robot.
  [[nodiscard]] const Trajectory& truth() const { return truth_.poses(); }

 private:
  void on_association(const Association& association);

  MapSubscription subscription_;
  std::map<int, LocalMap> local_maps_;
  std::vector<Association> associations_;
  std::optional<MapGraph> graph_;
  std::vector<MapContradiction> contradictions_;
  static constexpr double kTruthToleranceM = 0.002;
  static constexpr double kJitterM = 0.005;  ///< more than scan matching has
  ThinnedTrajectory odometry_{kJitterM};
  ThinnedTrajectory truth_{kTruthToleranceM};
};

}  // namespace adit
