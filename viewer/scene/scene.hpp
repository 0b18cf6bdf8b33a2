// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "common/bus/bus.hpp"
#include "common/bus/map_subscription.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/terrain.hpp"
#include "viewer/scene/driven_path.hpp"
#include "viewer/scene/layers/map_layer.hpp"
#include "viewer/scene/layers/mission_layer.hpp"
#include "viewer/scene/layers/robot_layer.hpp"
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
  void subscribe_objects();

  Bus& bus_;
  const SceneParameters parameters_;
  std::int64_t simulated_utime_ = 0;
  MapSubscription map_subscription_;
  TerrainReassembler terrain_fragments_;
  MapFrame frame_;
  DrivenPath path_{frame_};
  RobotLayer robot_;
  MapLayer map_;
  MissionLayer mission_;
};

}  // namespace adit
