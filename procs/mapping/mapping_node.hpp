// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "common/bus/bus.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/mapping/local_map.hpp"
#include "procs/mapping/map_journal.hpp"
#include "procs/mapping/map_resender.hpp"
#include "procs/mapping/mapping.hpp"

namespace adit {

struct MappingNodeParams : MappingParams {
  std::string journal;  ///< file that keeps what was learnt; empty: nothing is kept
  /// Of the way, after which what there is of a local map goes there.
  double journal_interval_m = 0.3;

  template <class V>
  void visit(V& v) {
    v("journal", journal);
    v("journal_interval_m", journal_interval_m, within(0.05, 10.0));
    MappingParams::visit(v);
  }
};

/// In:  LASER_FRONT, LASER_REAR (planar_lidar_t); SCAN_MATCH (scan_match_t), one for each scan;
///      MAP_REQUEST (map_request_t).
/// Out: with each local map LOCAL_MAP (local_map_t) and POSE_GRAPH (pose_graph_t), both in pieces,
///      ASSOCIATION (association_t) for each decision, MAP_CORRECTION (map_correction_t). All
///      local maps again for those who ask, some pieces at a time, with the graph before and after.
/// Where a journal is named and there, the map in it is continued: after a restart nothing is lost
/// but the last 0.3 m of the way (`journal_interval_m`), and what is known goes out at once.
class MappingNode {
 public:
  using Params = MappingNodeParams;

  /// Throws std::runtime_error where the journal cannot be used.
  MappingNode(Bus& bus, const Params& params);

  [[nodiscard]] Health health() const { return health_; }
  [[nodiscard]] const Mapping& map() const { return mapping_; }

 private:
  void on_match(const ScanMatch& match);
  void restore(const std::string& journal);
  void write_journal(const std::function<void()>& append);
  void journal_unfinished();
  void handle_update(const MapUpdate& update);
  void publish_update(const MapUpdate& update);
  void publish_graph();
  void publish_correction();
  void resend();

  Bus& bus_;
  Params params_;
  Mapping mapping_;
  MapResender resender_;
  std::deque<LocalMapFragment> resend_queue_;  ///< pieces that are to be sent again
  bool graph_pending_ = false;                 ///< it is to go out with the next tick
  std::optional<MapJournal> journal_;
  std::optional<MapUpdate> restored_;  ///< what came of the local map that was being made
  int journaled_map_ = -1;             ///< id of the newest of which a part is kept
  bool start_pending_ = false;         ///< nothing of the first local map is kept
  Pose2 T_local_journaled_;            ///< the body at the end of that part
  std::map<std::string, std::deque<LaserScan>> waiting_;  ///< scans without their match, by channel
  Health health_;
};

}  // namespace adit
