// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/bus/bus.hpp"
#include "common/records/hazard.hpp"
#include "common/sensing/vehicle_readings.hpp"
#include "common/types/planned_path.hpp"
#include "common/types/terrain_map.hpp"
#include "common/types/vehicle.hpp"
#include "viewer/scene/layers/robot_layer.hpp"
#include "viewer/scene/map_frame.hpp"
#include "viewer/server/topic_board.hpp"

namespace adit {

/// Places that endanger or block the robot, /hazards, by PATH, TERRAIN, GAS and SINKAGE (see
/// common/records/hazard.hpp). Observations of one kind next to each other are one hazard.
class HazardLayer {
 public:
  /// All must outlive this.
  HazardLayer(Bus& bus, TopicBoard& board, const MapFrame& frame, const RobotLayer& robot,
              const Vehicle& vehicle);
  HazardLayer(const HazardLayer&) = delete;
  HazardLayer& operator=(const HazardLayer&) = delete;

  void add_path(const PlannedPath& path);
  /// `number`: of the 3D scan.
  void add_terrain(const TerrainMap& terrain, int number);
  /// Poses have changed.
  void set_changed(std::int64_t utime);

 private:
  struct AnchoredHazard {
    Hazard hazard;
    AnchoredPose T_centre;
  };

  void on_gas(const GasReading& reading);
  void on_sinkage(const SinkageReading& reading);
  [[nodiscard]] LevelPose T_odom_body() const;
  void add(const std::vector<Hazard>& observed);
  void add(const Hazard& observed);
  [[nodiscard]] std::string hazards_message() const;

  TopicBoard& board_;
  const MapFrame& frame_;
  const RobotLayer& robot_;
  const Vehicle& vehicle_;
  TopicId topic_ = 0;
  std::int64_t utime_ = 0;
  std::vector<AnchoredHazard> hazards_;
};

}  // namespace adit
