// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/bus/bus.hpp"
#include "common/sensing/vehicle_readings.hpp"
#include "common/types/planned_path.hpp"
#include "common/types/terrain_map.hpp"
#include "common/types/vehicle.hpp"
#include "viewer/scene/layers/robot_layer.hpp"
#include "viewer/scene/map_frame.hpp"
#include "viewer/server/topic_board.hpp"

namespace adit {

/// Places that endanger or block the robot, /hazards: cells that block a path (PATH: steps, low
/// roof, water, drops, slopes), ground without returns and low roof (TERRAIN), gas at the limits of
/// 30 CFR 75.321 to 75.323 (GAS), and deep sinkage (SINKAGE). Observations of one kind next to each
/// other are one hazard.
class HazardLayer {
 public:
  static constexpr std::size_t kHazardsMax = 1000;

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
  struct Hazard {
    std::string kind;
    double value = 0.0;
    std::string unit;
    std::string evidence;
    std::int64_t utime = 0;
    AnchoredPose T_centre;
    Eigen::Vector2d size_m{0.0, 0.0};
  };

  void on_gas(const GasReading& reading);
  void on_sinkage(const SinkageReading& reading);
  void add_at_robot(const std::string& kind, double value, const std::string& unit,
                    const std::string& evidence, std::int64_t utime);
  void add(const Hazard& observed);
  [[nodiscard]] std::string hazards_message() const;

  TopicBoard& board_;
  const MapFrame& frame_;
  const RobotLayer& robot_;
  const Vehicle& vehicle_;
  TopicId topic_ = 0;
  std::int64_t utime_ = 0;
  std::vector<Hazard> hazards_;
};

}  // namespace adit
