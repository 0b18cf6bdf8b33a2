// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/messages/mapping/local_map.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/pose_graph/map_graph.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/sensing/scan_match.hpp"
#include "common/types/association.hpp"
#include "common/types/local_map.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {

/// Receives the output of mapping: LOCAL_MAP and POSE_GRAPH, reassembled from their fragments, and
/// ASSOCIATION.
class MapSubscription {
 public:
  struct Handlers {
    std::function<void(LocalMap)> on_local_map;
    std::function<void(MapGraph)> on_graph;
    std::function<void(const Association&)> on_association;
  };

  /// Must be called once. `bus` must not deliver messages after this is destroyed.
  void subscribe(Bus& bus, Handlers handlers);

 private:
  Handlers handlers_;
  LocalMapReassembler local_map_fragments_;
  PoseGraphReassembler graph_fragments_;
};

/// Collects the data for the result files of a run: all scan matches, the output of mapping, and
/// the scans that are not in a local map yet.
class RunRecord {
 public:
  struct Entry {
    LaserScan scan;
    ScanMatch match;
  };

  /// An interval of consecutive scans that were degenerate or lost.
  struct Segment {
    std::int64_t from_utime = 0;
    std::int64_t to_utime = 0;
    double length_m = 0.0;
    int scans = 0;
    bool lost = false;    ///< false: degenerate
    bool filled = false;  ///< degenerate, with the open direction taken from odometry or gyro
  };

  /// `bus` must outlive this.
  explicit RunRecord(Bus& bus);

  /// Matches of all scans with a pose, in order.
  [[nodiscard]] const std::vector<ScanMatch>& matches() const { return matches_; }
  [[nodiscard]] std::size_t rejected_scans() const { return rejected_; }
  /// Scans after the last local map, except for lost ones and for those less than 0.1 m and 0.1 rad
  /// from the previous one.
  [[nodiscard]] const std::vector<Entry>& tail() const { return tail_; }

  [[nodiscard]] const std::vector<LocalMap>& local_maps() const { return local_maps_; }
  [[nodiscard]] const std::vector<Association>& associations() const { return associations_; }
  /// Last POSE_GRAPH; nothing before the first local map.
  [[nodiscard]] const std::optional<MapGraph>& graph() const { return graph_; }

  /// T_odom_body at each scan.
  [[nodiscard]] Trajectory odometry() const;
  [[nodiscard]] std::vector<Segment> segments() const;

 private:
  void subscribe_laser(Bus& bus, std::string_view channel);
  void on_match(const ScanMatch& match);
  void on_local_map(LocalMap map);
  [[nodiscard]] bool is_far_from_tail(const ScanMatch& match) const;

  std::map<std::string, LaserScan> last_scan_;
  std::vector<ScanMatch> matches_;
  std::vector<Entry> tail_;
  std::size_t rejected_ = 0;
  MapSubscription map_subscription_;
  std::vector<LocalMap> local_maps_;
  std::vector<Association> associations_;
  std::optional<MapGraph> graph_;
};

/// True for a lost scan and for one with a degenerate direction.
bool is_unobserved(const ScanMatch& match);

}  // namespace adit
