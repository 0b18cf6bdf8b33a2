// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/messages/mapping/local_map.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/pose_graph/map_correction.hpp"
#include "common/pose_graph/map_graph.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/sensing/scan_match.hpp"
#include "common/types/association.hpp"
#include "common/types/local_map.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {

/// Listens to a run and keeps what its files are made of: what became of every scan, the local
/// maps, and the scans for which there is no local map yet.
class RunRecord {
 public:
  struct Entry {
    LaserScan scan;
    ScanMatch match;
  };

  /// A stretch of the way over which scans left a direction open or matched nothing.
  struct Segment {
    std::int64_t from_utime = 0;
    std::int64_t to_utime = 0;
    double length_m = 0.0;
    int scans = 0;
    bool lost = false;    ///< otherwise degenerate
    bool filled = false;  ///< degenerate, but odometry or gyro stood in
  };

  /// `bus` must outlive this.
  explicit RunRecord(Bus& bus);

  /// Of the scans that gave a pose, in order.
  [[nodiscard]] const std::vector<ScanMatch>& matches() const { return matches_; }
  [[nodiscard]] std::size_t rejected_scans() const { return rejected_; }
  /// The scans after the last local map; without the lost, and without those that a body at rest
  /// takes over and over.
  [[nodiscard]] const std::vector<Entry>& tail() const { return tail_; }

  [[nodiscard]] const std::vector<LocalMap>& local_maps() const { return local_maps_; }
  [[nodiscard]] const std::vector<Association>& associations() const { return associations_; }
  /// The last one; nothing before the first local map.
  [[nodiscard]] const std::optional<MapGraph>& graph() const { return graph_; }
  [[nodiscard]] const std::optional<MapCorrection>& correction() const { return correction_; }

  /// T_odom_body at each scan.
  [[nodiscard]] Trajectory odometry() const;
  [[nodiscard]] std::vector<Segment> segments() const;

 private:
  void subscribe_laser(Bus& bus, std::string_view channel);
  void subscribe_mapping(Bus& bus);
  void on_match(const ScanMatch& match);
  void on_local_map(LocalMap map);
  [[nodiscard]] bool is_far_from_tail(const ScanMatch& match) const;

  std::map<std::string, LaserScan> last_scan_;
  std::vector<ScanMatch> matches_;
  std::vector<Entry> tail_;
  std::size_t rejected_ = 0;
  LocalMapReassembler local_map_fragments_;
  PoseGraphReassembler graph_fragments_;
  std::vector<LocalMap> local_maps_;
  std::vector<Association> associations_;
  std::optional<MapGraph> graph_;
  std::optional<MapCorrection> correction_;
};

/// Did the scan leave a direction open, or match nothing?
bool is_unobserved(const ScanMatch& match);

}  // namespace adit
