// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "common/bus/bus.hpp"
#include "common/bus/map_subscription.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/terrain.hpp"
#include "viewer/scene/anchored_path.hpp"
#include "viewer/scene/layers/cloud_layer.hpp"
#include "viewer/scene/layers/event_layer.hpp"
#include "viewer/scene/layers/frontier_layer.hpp"
#include "viewer/scene/layers/graph_layer.hpp"
#include "viewer/scene/layers/hazard_layer.hpp"
#include "viewer/scene/layers/history_layer.hpp"
#include "viewer/scene/layers/map_layer.hpp"
#include "viewer/scene/layers/mission_layer.hpp"
#include "viewer/scene/layers/path_layer.hpp"
#include "viewer/scene/layers/process_layer.hpp"
#include "viewer/scene/layers/robot_layer.hpp"
#include "viewer/scene/layers/scan_layer.hpp"
#include "viewer/scene/layers/uncertainty_layer.hpp"
#include "viewer/scene/map_frame.hpp"
#include "viewer/scene/scene_parameters.hpp"
#include "viewer/server/topic_board.hpp"

namespace adit {

/// All topics of viewer/README.md but /summary, from the messages on a bus. Publishes nothing on
/// the bus. A message costs its decoding; a topic is encoded when somebody wants it (TopicBoard).
class Scene {
 public:
  /// All must outlive this.
  Scene(Bus& bus, TopicBoard& board, const SceneParameters& parameters);
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// The newest time of the messages: that of SIM_TIME with a simulator, else bus time [µs since
  /// the epoch].
  [[nodiscard]] std::int64_t now_utime() const;

 private:
  void subscribe_map();
  void subscribe_path();
  void subscribe_scans();
  void on_graph(std::int64_t utime);
  /// Of the newest scan of a laser.
  void on_match(const ScanMatch& match);

  Bus& bus_;
  const SceneParameters parameters_;
  std::int64_t simulated_utime_ = 0;
  MapSubscription map_subscription_;
  CloudReassembler cloud_fragments_;
  TerrainReassembler terrain_fragments_;
  int scan_ = 0;  ///< number of the newest 3D scan
  MapFrame frame_;
  AnchoredPath path_{frame_};
  RobotLayer robot_;
  MapLayer map_;
  CloudLayer clouds_;
  PathLayer paths_;
  GraphLayer graph_;
  FrontierLayer frontiers_;
  HazardLayer hazards_;
  UncertaintyLayer uncertainty_;
  MissionLayer mission_;
  ProcessLayer processes_;
  EventLayer events_;
  ScanLayer scans_;
  HistoryLayer history_;
};

}  // namespace adit
