// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <utility>
#include <vector>

#include "common/sensing/scan_match.hpp"
#include "common/types/local_map.hpp"
#include "procs/mapping/local_map_builder.hpp"
#include "procs/mapping/loop_closure/local_walls.hpp"
#include "tools/eval/relations.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {

/// A recording after scan matching, cut into local maps, and what is known of the truth.
struct MappedRun {
  std::vector<ScanMatch> matches;
  Trajectory odom;  ///< T_odom_body at each match
  std::vector<LocalMap> maps;
  std::vector<LocalWalls> walls;  ///< of each of the maps
  std::vector<Relation> relations;

  /// T_local_body at a time in a local map.
  [[nodiscard]] Pose2 pose_in_map(int map, std::int64_t utime) const;
  /// The local map that holds a time, or −1.
  [[nodiscard]] int map_at(std::int64_t utime) const;
};

/// A CARMEN log with its relations.
MappedRun map_recording(const std::filesystem::path& log, const std::filesystem::path& relations,
                        bool use_odometry);

/// A CARMEN log whose pose fields hold a path that others have corrected by closing loops: the
/// laser alone, with relations made of that path as those of the sample mine are of its truth.
MappedRun map_corrected(const std::filesystem::path& log);

/// A drive through the sample mine, with relations made from its truth: over 5, 20 and 50 m of way,
/// and between passes by the same place.
MappedRun map_sample(std::uint64_t seed, bool half_degree, bool use_odometry);

/// How much relations differ from scan matching over ways so short that it cannot be wrong: the
/// scatter of the relations themselves, by median, of (x or y, θ).
struct Scatter {
  double sd_m = 0.0;
  double sd_rad = 0.0;

  [[nodiscard]] Eigen::Matrix3d covariance() const {
    return Eigen::Vector3d(sd_m * sd_m, sd_m * sd_m, sd_rad * sd_rad).asDiagonal();
  }
};

Scatter scatter_of_relations(const MappedRun& run);

/// Two local maps that lie together, and how: T_older_newer as the relations have it.
using TruePairs = std::map<std::pair<int, int>, Pose2>;

/// All pairs of maps, other than neighbours in the chain, between which there is a relation at
/// times where a scan was taken or the body hardly moved.
TruePairs true_pairs(const MappedRun& run);

/// Normalised error squared of displacements (expectation 3, median 2.4), by length of way. The
/// scatter of the relations is counted with the model.
struct DisplacementScore {
  double from_m = 0.0;
  double to_m = 0.0;
  int count = 0;
  double nees = 0.0;
  double nees_median = 0.0;
  double translation_m = 0.0;  ///< mean error
  double rotation_deg = 0.0;
  double sd_m = 0.0;  ///< mean of what the model says, per axis
  double sd_deg = 0.0;
};

std::vector<DisplacementScore> score_displacements(const MappedRun& run,
                                                   const LocalMapBuilderParams& params);

}  // namespace adit
