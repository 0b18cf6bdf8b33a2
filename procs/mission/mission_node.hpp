// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/bus/bus.hpp"
#include "common/files/disk_space.hpp"
#include "common/messages/diagnostics.hpp"
#include "procs/mission/mission.hpp"
#include "procs/mission/mission_journal.hpp"

namespace adit {

struct MissionNodeParams : MissionParams {
  std::string journal;  ///< file with the state of the mission; empty: none

  template <class V>
  void visit(V& v) {
    v("journal", journal);
    MissionParams::visit(v);
  }
};

/// In:  POSE (pose_t), SCAN_MATCH (scan_match_t), MAP_CORRECTION (map_correction_t), EXPLORATION
///      (exploration_t), TERRAIN_READY (terrain_ready_t), PATH (planned_path_t), DRIVING_STATE
///      (driving_state_t), VEHICLE_STATE (vehicle_state_t), GAS (gas_t), SINKAGE (sinkage_t),
///      HEARTBEAT (heartbeat_t) of stages whose journal fails, MISSION_ORDER (mission_order_t). Not
///      CLOUD and TERRAIN, 2 MB with each 3D scan: the receive buffer of LCM grows to the largest
///      burst that ever waited, and does not shrink.
/// Out: PHASE (phase_t), on change and each second; EXPLORE_REQUEST (explore_request_t),
///      SCAN_REQUEST (scan_request_t) and GOAL (plan_goal_t), each repeated until it is answered.
class MissionNode {
 public:
  using Params = MissionNodeParams;

  /// Throws std::runtime_error if the journal cannot be used.
  MissionNode(Bus& bus, const Params& params);

  /// Degraded while the mission waits, if the robot does not know where home is or the journal was
  /// damaged; fault if the robot is stranded or the journal fails.
  [[nodiscard]] Health health() const;

 private:
  void subscribe_to_stages();
  void on_heartbeat(const Heartbeat& heartbeat);
  void on_correction(const MapCorrection& correction);
  void advance();
  void publish_phase();
  template <class Record>
  void store(const Record& record);

  Bus& bus_;
  Mission mission_;
  std::optional<MissionJournal> journal_;
  std::optional<DiskSpace> space_;  ///< for the journals
  std::string journal_failure_;
  std::int32_t published_sequence_ = -1;
  std::int64_t published_utime_ = 0;
};

}  // namespace adit
