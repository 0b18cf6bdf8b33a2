// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>

#include "common/bus/bus.hpp"
#include "common/messages/heartbeat.hpp"
#include "procs/mapping/map_journal.hpp"
#include "procs/mapping/map_repeater.hpp"
#include "procs/mapping/mapping.hpp"

namespace adit {

struct MappingNodeParams : MappingParams {
  std::string journal;  ///< file that keeps what was learnt; empty: nothing is kept

  template <class V>
  void visit(V& v) {
    v("journal", journal);
    MappingParams::visit(v);
  }
};

/// In:  LASER_FRONT, LASER_REAR (planar_lidar_t); SCAN_MATCH (scan_match_t), one for each scan;
///      MAP_REQUEST (map_request_t).
/// Out: with each local map LOCAL_MAP (local_map_t) and POSE_GRAPH (pose_graph_t), both in pieces,
///      ASSOCIATION (association_t) for each decision, MAP_CORRECTION (map_correction_t). All
///      local maps again for those who ask, some pieces at a time, with the graph before and after.
/// Where a journal is named and there, the map in it is continued: after a restart of the process
/// nothing is lost but the local map that was at hand.
class MappingNode {
 public:
  using Params = MappingNodeParams;

  /// Throws std::runtime_error where the journal cannot be used.
  MappingNode(Bus& bus, const Params& params);

  [[nodiscard]] Health health() const { return health_; }

 private:
  void on_match(const ScanMatch& match);
  void pass_on(const MapUpdate& update);
  void publish_graph();
  void repeat();

  Bus& bus_;
  Mapping mapping_;
  MapRepeater repeater_;
  bool graph_due_ = false;  ///< it is to go out with the next tick
  std::optional<MapJournal> journal_;
  std::map<std::string, std::deque<LaserScan>> waiting_;  ///< scans without their match, by channel
  Health health_;
};

}  // namespace adit
