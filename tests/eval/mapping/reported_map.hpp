// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "tools/eval/relations.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {

/// A map with what it reports about itself.
struct ReportedMap {
  struct Stretch {
    std::int64_t from_utime = 0;
    std::int64_t to_utime = 0;
  };

  Trajectory trajectory;           ///< T_map_body
  std::vector<Stretch> stretches;  ///< doubtful ones of summary.json
};

/// Maps a log as `adit map` does.
ReportedMap map_log(const std::filesystem::path& log, bool use_odometry);

/// A trajectory at the times of another one.
Trajectory sampled(const Trajectory& trajectory, const Trajectory& times);

/// Path length up to each pose [m].
std::vector<double> distances(const Trajectory& path);

/// Relations of a trajectory: of each pose with the one 10 m of path on, and with the one half the
/// path on.
std::vector<Relation> relations_of(const Trajectory& truth);

/// Mean error of the translations of relations [m].
double error_m(const std::vector<Relation>& relations, const Trajectory& trajectory);

/// Whether a part of a path lies within 5 m, a local map, of a doubtful stretch. `truth`: the true
/// path, `along`: its distances.
bool reports(const ReportedMap& map, const Trajectory& truth, const std::vector<double>& along,
             double from_m, double to_m);

}  // namespace adit
