// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tools/ros/import/topic_choice.hpp"

namespace adit {

struct MapRunOptions {
  std::filesystem::path input;   ///< CARMEN log, plain or gzip, LCM log, or bag of ROS
  std::filesystem::path folder;  ///< created if it does not exist
  std::filesystem::path config;  ///< YAML, or empty: defaults
  bool use_odometry = true;      ///< false: wheel odometry and IMU are not replayed
  std::filesystem::path resume;  ///< folder of an earlier run whose map is continued, or empty
  bool draw_graph = false;       ///< draw the pose graph into map.png
  TopicChoice topics = {};       ///< of a bag
};

struct MapRunResult {
  std::size_t scans = 0;
  std::size_t lost = 0;
  double path_length_m = 0.0;
  std::size_t local_maps = 0;                   ///< of the full map
  std::size_t loop_closures = 0;                ///< accepted at the end
  std::size_t cross_session_loop_closures = 0;  ///< of those: from this run to the resumed map
  std::string doubtful;  ///< stretches on which the map may be wrong, in a line; empty: none
  double wall_s = 0.0;
  std::vector<std::string> warnings;  ///< one sentence each
};

/// Runs scan matching and mapping on a log in this process, as fast as possible, and writes
/// trajectory.tum (T_map_body), odometry.tum (T_odom_body), map.png, map.pgm and map.yaml,
/// graph.g2o, associations.tsv, map.journal (the state of mapping, to resume from), run.lcmlog (all
/// input and output messages) and summary.json. The same log, configuration and build give the same
/// files, byte for byte, except for the times in summary.json. A resumed map keeps its frame, and
/// the files cover both runs; `resume` and `folder` may be the same folder. `progress` is called
/// with the name of the current step and the finished share of it. Throws ConfigError or
/// std::runtime_error; the folder is unchanged then.
MapRunResult run_map(const MapRunOptions& options,
                     const std::function<void(const std::string& label, double done)>& progress);

}  // namespace adit
