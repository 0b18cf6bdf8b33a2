// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "common/sensing/scan_match.hpp"
#include "common/types/local_map.hpp"
#include "procs/mapping/local_map_builder.hpp"
#include "procs/mapping/loop_closure/local_walls.hpp"
#include "tools/eval/relations.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {

/// A recording after scan matching, split into local maps, with its reference relations.
struct MappedRun {
  std::vector<ScanMatch> matches;
  Trajectory odom;  ///< T_odom_body at each match
  std::vector<LocalMap> maps;
  std::vector<std::shared_ptr<const LocalWalls>> walls;  ///< of each local map
  std::vector<Relation> relations;

  /// T_local_body at a time in a local map.
  [[nodiscard]] Pose2 pose_in_map(int map, std::int64_t utime) const;
  /// The local map whose time interval contains a time, or −1.
  [[nodiscard]] int map_at(std::int64_t utime) const;
};

/// Processes a CARMEN log with its relations.
MappedRun map_recording(const std::filesystem::path& log, const std::filesystem::path& relations,
                        bool use_odometry);

/// Processes a CARMEN log whose pose fields hold a path corrected by loop closing: uses the laser
/// only, and derives relations from that path as map_sample does from the ground truth.
MappedRun map_corrected(const std::filesystem::path& log);

/// Processes a drive through the sample mine, with relations derived from its ground truth: over
/// path lengths of 5, 20 and 50 m, and between revisits of the same place.
MappedRun map_sample(int seed, bool half_degree, bool use_odometry);

/// Standard deviation of the relations, estimated robustly (by the median) from their differences
/// from scan matching over paths of at most 2 m, where the errors of scan matching are negligible.
struct Scatter {
  double sd_m = 0.0;
  double sd_rad = 0.0;

  [[nodiscard]] Eigen::Matrix3d covariance() const {
    return Eigen::Vector3d(sd_m * sd_m, sd_m * sd_m, sd_rad * sd_rad).asDiagonal();
  }
};

Scatter scatter_of_relations(const MappedRun& run);

/// Overlapping local maps (older, newer) with T_older_newer by the relations.
using TruePairs = std::map<std::pair<int, int>, Pose2>;

/// All pairs of local maps, except neighbours in the chain, with a relation of at most 5 m between
/// them at times of scans or of slow motion, where interpolated poses are accurate.
TruePairs true_pairs(const MappedRun& run);

/// Normalized estimation error squared (NEES; expectation 3, median 2.4) of displacements over one
/// range of path length. The covariance includes the scatter of the relations.
struct DisplacementScore {
  double from_m = 0.0;
  double to_m = 0.0;
  int count = 0;
  double nees = 0.0;
  double nees_median = 0.0;
  double translation_m = 0.0;  ///< mean error
  double rotation_deg = 0.0;
  double sd_m = 0.0;  ///< mean standard deviation of the error model, per axis
  double sd_deg = 0.0;
};

std::vector<DisplacementScore> score_displacements(const MappedRun& run,
                                                   const LocalMapBuilderParams& params);

}  // namespace adit
