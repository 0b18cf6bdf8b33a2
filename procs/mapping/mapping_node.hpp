// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/bus/sensor_clocks.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/local_map.hpp"
#include "procs/mapping/map_journal.hpp"
#include "procs/mapping/map_resender.hpp"
#include "procs/mapping/mapping.hpp"

namespace adit {

struct MappingNodeParams : MappingParams {
  std::string journal;  ///< file in which the map is stored; empty: nothing is stored
  /// Path length after which the unfinished local map is stored.
  double journal_interval_m = 0.3;

  template <class V>
  void visit(V& v) {
    v("journal", journal);
    v("journal_interval_m", journal_interval_m, within(0.05, 10.0));
    MappingParams::visit(v);
  }
};

/// In:  LASER_FRONT, LASER_REAR (planar_lidar_t); SCAN_MATCH (scan_match_t), one for each scan;
///      MAP_REQUEST (map_request_t); WHEEL_ODOMETRY (wheel_odometry_t), if there are wheels; CLOUD
///      (cloud_t), if there are 3D scans.
/// Out: with each local map LOCAL_MAP (local_map_t) and POSE_GRAPH (pose_graph_t), both in
///      fragments, ASSOCIATION (association_t) for each decision, CLOUD_MATCH
///      (cloud_match_t) for each match of 3D scans, MAP_CORRECTION
///      (map_correction_t), which is repeated each second with the present uncertainty;
///      CONTRADICTIONS (map_contradictions_t) on change.
///      On request all local maps again, some fragments at a time, with the graph before and after.
/// If a journal is configured and exists, its map is continued: after a restart only the last 0.3 m
/// of the path (`journal_interval_m`) are lost, and the map is published immediately.
class MappingNode {
 public:
  using Params = MappingNodeParams;

  /// Throws std::runtime_error if the journal cannot be used.
  MappingNode(Bus& bus, const Params& params);

  /// Fault if the journal cannot be written; degraded if it was damaged when it was opened, or if
  /// the clock of a sensor is off.
  [[nodiscard]] Health health() const;
  [[nodiscard]] const Mapping& map() const { return mapping_; }

 private:
  void on_match(const ScanMatch& match);
  void restart_time();
  void restore(const std::string& journal);
  void store(const MapUpdate& update);
  void write_journal(const std::function<void()>& append);
  void journal_unfinished();
  void handle_update(const MapUpdate& update);
  void publish_update(const MapUpdate& update);
  void publish_graph();
  void publish_contradictions();
  void publish_correction();
  void resend();

  Bus& bus_;
  Params params_;
  Mapping mapping_;
  SensorClocks clocks_{[this] { restart_time(); }};
  CloudReassembler clouds_;
  MapResender resender_;
  std::deque<LocalMapFragment> resend_queue_;  ///< fragments to resend
  std::optional<std::vector<MapContradiction>> published_contradictions_;
  bool graph_pending_ = false;  ///< publish the graph at the next tick
  std::optional<MapJournal> journal_;
  std::optional<MapUpdate> restored_;  ///< update by the restored unfinished local map
  int journaled_map_ = -1;             ///< id of the newest local map of which a part is stored
  bool start_pending_ = false;         ///< nothing of the first local map is stored
  Pose2 T_local_journaled_;            ///< pose at the end of that part
  /// Scans waiting for their match, by channel.
  std::map<std::string, std::deque<LaserScan>> waiting_;
  std::deque<MapUpdate> unstored_;  ///< updates that the disk has not taken
  std::string journal_failure_;
};

}  // namespace adit
