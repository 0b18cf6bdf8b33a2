// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/bus/map_subscription.hpp"
#include "common/files/spool.hpp"
#include "common/pose_graph/map_graph.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/sensing/scan_match.hpp"
#include "common/types/association.hpp"
#include "common/types/local_map.hpp"
#include "common/types/map_contradictions.hpp"
#include "procs/mapping/local_map_store.hpp"
#include "tools/eval/trajectory.hpp"
#include "tools/map/doubt_list.hpp"
#include "tools/map/segment_list.hpp"

namespace adit {

/// Collects the data for the result files of a run: what the summary counts, one pose per scan, the
/// output of mapping, and the scans that are not in a local map yet. Memory grows with the local
/// maps, by their poses and loop closures; what grows with the scans is in temporary files.
class RunRecord {
 public:
  struct Entry {
    LaserScan scan;
    ScanMatch match;
  };

  /// Number of scans by what scan matching made of them.
  struct Counts {
    std::size_t with_pose = 0;  ///< all but the rejected ones
    std::size_t matched = 0;
    std::size_t lost = 0;
    std::size_t rejected = 0;  ///< time did not advance
    std::size_t searched = 0;
    std::size_t degenerate = 0;
  };

  /// `bus` must outlive this. What is long goes to temporary files in `scratch`.
  explicit RunRecord(Bus& bus,
                     const std::filesystem::path& scratch = std::filesystem::temp_directory_path());

  [[nodiscard]] const Counts& counts() const { return counts_; }
  /// Scans after the last local map, except for lost ones and for those less than 0.1 m and 0.1 rad
  /// from the previous one.
  [[nodiscard]] const std::vector<Entry>& tail() const { return tail_; }

  [[nodiscard]] const LocalMapStore& local_maps() const { return local_maps_; }
  [[nodiscard]] const std::vector<Association>& associations() const { return associations_; }
  /// Last POSE_GRAPH; nothing before the first local map.
  [[nodiscard]] const std::optional<MapGraph>& graph() const { return graph_; }
  /// Local maps that contradict each other at the end.
  [[nodiscard]] const std::vector<MapContradiction>& contradictions() const {
    return contradictions_;
  }

  /// T_odom_body at each scan with a pose.
  [[nodiscard]] const Spool<TimedPose>& odometry() const { return odometry_; }
  /// For each pose of `odometry`, 1 if a scan at its time did not observe all motion, else 0.
  [[nodiscard]] const Spool<std::uint8_t>& unobserved() const { return unobserved_; }
  [[nodiscard]] const SegmentList& segments() const { return segments_; }
  /// Motions between scans that may be wrong.
  [[nodiscard]] const Spool<MotionDoubt>& doubts() const { return doubts_; }

 private:
  void subscribe_laser(Bus& bus, std::string_view channel);
  void on_match(const ScanMatch& match);
  void add_pose(const ScanMatch& match);
  void on_local_map(LocalMap map);
  [[nodiscard]] bool is_far_from_tail(const ScanMatch& match) const;

  std::map<std::string, LaserScan> last_scan_;
  Counts counts_;
  Spool<TimedPose> odometry_;
  Spool<std::uint8_t> unobserved_;
  SegmentList segments_;
  Spool<MotionDoubt> doubts_;
  std::vector<Entry> tail_;
  MapSubscription map_subscription_;
  LocalMapStore local_maps_;
  std::vector<Association> associations_;
  std::vector<MapContradiction> contradictions_;
  std::optional<MapGraph> graph_;
};

}  // namespace adit
