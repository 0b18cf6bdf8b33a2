// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/bus/bus.hpp"
#include "common/sensing/scan_match.hpp"
#include "common/sensing/vehicle_readings.hpp"
#include "common/types/driving_state.hpp"
#include "common/types/exploration.hpp"
#include "common/types/mission.hpp"
#include "common/types/vehicle_state.hpp"
#include "viewer/scene/map_frame.hpp"
#include "viewer/server/topic_board.hpp"

namespace adit {

/// The state of the mission and of the robot, /mission, from PHASE, EXPLORATION, DRIVING_STATE,
/// STOP, VEHICLE_STATE, GAS, SCAN_MATCH and MAP_CORRECTION.
class MissionLayer {
 public:
  /// All must outlive this.
  MissionLayer(Bus& bus, TopicBoard& board, const MapFrame& frame);
  MissionLayer(const MissionLayer&) = delete;
  MissionLayer& operator=(const MissionLayer&) = delete;

  [[nodiscard]] const std::optional<MissionPhase>& phase() const { return phase_; }
  [[nodiscard]] const std::optional<VehicleState>& vehicle() const { return vehicle_; }
  [[nodiscard]] const std::optional<GasReading>& gas() const { return gas_; }

 private:
  void set_changed(std::int64_t utime);
  [[nodiscard]] std::string mission_message() const;

  TopicBoard& board_;
  const MapFrame& frame_;
  TopicId topic_ = 0;
  std::int64_t utime_ = 0;
  std::optional<MissionPhase> phase_;
  std::optional<ExplorationReport> exploration_;
  std::optional<DrivingState> driving_;
  std::optional<StopOrder> stop_;
  std::optional<VehicleState> vehicle_;
  std::optional<GasReading> gas_;
  std::optional<double> match_quality_;
};

}  // namespace adit
