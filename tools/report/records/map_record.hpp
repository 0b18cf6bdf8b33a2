// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/messages/mapping/local_map.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/pose_graph/map_graph.hpp"
#include "common/types/association.hpp"
#include "common/types/local_map.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {

/// Listens to what mapping says, to POSE and to TRUTH. Of poses it keeps one for each step of a few
/// centimetres or a second, so that a log of hours fits.
class MapRecord {
 public:
  /// `bus` must outlive this.
  explicit MapRecord(Bus& bus);

  /// The newest of each id, in order.
  [[nodiscard]] std::vector<LocalMap> release_local_maps();
  [[nodiscard]] const std::map<int, LocalMap>& local_maps() const { return local_maps_; }
  /// A decision that was told again after a restart is there once.
  [[nodiscard]] const std::vector<Association>& associations() const { return associations_; }
  /// The last one.
  [[nodiscard]] const std::optional<MapGraph>& graph() const { return graph_; }

  /// T_odom_body, thinned. Where the process began anew, odom may begin anew.
  [[nodiscard]] const Trajectory& odometry() const { return odometry_; }
  /// T_world_body of a simulator, thinned; empty on a robot.
  [[nodiscard]] const Trajectory& truth() const { return truth_; }

 private:
  void on_association(const Association& association);

  LocalMapReassembler local_map_fragments_;
  PoseGraphReassembler graph_fragments_;
  std::map<int, LocalMap> local_maps_;
  std::vector<Association> associations_;
  std::optional<MapGraph> graph_;
  Trajectory odometry_;
  Trajectory truth_;
};

}  // namespace adit
