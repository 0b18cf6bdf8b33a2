// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <utility>

#include "common/geometry/level_pose.hpp"
#include "common/pose_graph/map_correction.hpp"
#include "common/pose_graph/map_graph.hpp"
#include "common/types/local_map.hpp"

namespace adit {

/// A pose that moves with the local map near which it was measured, when the pose graph changes.
struct AnchoredPose {
  static constexpr int kNone = -1;

  int local_map = kNone;  ///< id; kNone before the first local map of a session
  LevelPose T_anchor;     ///< T_local_x, or T_map_x without a local map
};

/// Where odom and the local maps are in map.
class MapFrame {
 public:
  void set_correction(const MapCorrection& correction);
  void add_local_map(const LocalMap& map);
  void set_graph(MapGraph graph) { graph_ = std::move(graph); }

  /// Identity before the first MAP_CORRECTION.
  [[nodiscard]] const LevelPose& T_map_odom() const { return T_map_odom_; }
  [[nodiscard]] const std::optional<MapCorrection>& correction() const { return correction_; }
  [[nodiscard]] const MapGraph& graph() const { return graph_; }
  /// Pose of a local map; nothing if it is not in the graph.
  [[nodiscard]] std::optional<LevelPose> T_map_local(int id) const;

  [[nodiscard]] AnchoredPose anchored(const LevelPose& T_odom_x) const;
  /// T_map_x by the present graph.
  [[nodiscard]] LevelPose T_map(const AnchoredPose& pose) const;

 private:
  struct Newest {
    int id = 0;
    int session = 0;
    LevelPose T_odom_local;
  };

  LevelPose T_map_odom_;
  std::optional<MapCorrection> correction_;
  std::optional<Newest> newest_;
  MapGraph graph_;
};

}  // namespace adit
