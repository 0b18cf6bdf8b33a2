// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace adit {

struct MergeOptions {
  std::vector<std::filesystem::path>
      runs;                           ///< in order of time: folders of missions or of maps, or logs
  std::filesystem::path folder;       ///< created if it does not exist
  std::filesystem::path config = {};  ///< YAML, or empty: defaults
  bool draw_graph = false;            ///< draw the pose graph into map.png
};

struct MergeResult {
  std::size_t runs = 0;
  std::size_t joined = 0;  ///< runs in the map
  std::size_t local_maps = 0;
  std::size_t links = 0;  ///< loop closures between runs
  std::size_t changes = 0;
  bool is_global = false;               ///< the optimum is proven to be the global one
  std::vector<std::string> not_joined;  ///< a sentence for each run that is not in the map
  std::vector<std::string> warnings;    ///< one sentence each
  double wall_s = 0.0;
};

/// Joins the maps of runs into one and writes map.png, map.pgm and map.yaml, trajectory_N.tum of
/// each run N (from 1, in the order given; T_map_body at the scans of its local maps), graph.g2o,
/// changes.png and changes.tsv (what some runs saw as wall and others as free), map.journal (the
/// joined local maps, to resume from; only if all robots have the same lasers) and summary.json
/// (every join with its evidence). If not all runs can be joined, the files show the largest map,
/// and the result tells which runs are not in it. The same input gives the same files but for times
/// in summary.json. Throws ConfigError or std::runtime_error; the folder is unchanged then.
MergeResult run_merge(const MergeOptions& options,
                      const std::function<void(const std::string& step, double done)>& progress);

}  // namespace adit
