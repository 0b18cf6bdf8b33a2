// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "common/geometry/pose2.hpp"
#include "tools/eval/path_error.hpp"
#include "tools/eval/trajectory.hpp"
#include "tools/merge/run_groups.hpp"

namespace adit {

/// A run of a simulated mine.
struct TrueRun {
  std::string name;
  std::unique_ptr<Mapping> map;  ///< restored
  Trajectory truth;              ///< T_world_body
};

/// Of the folder of a mission or a map with run.lcmlog. `ahead_us`: time by which the estimated
/// poses of all runs are ahead of the stamps of their scans; the truth is taken so much later.
/// Throws std::runtime_error.
TrueRun open_true_run(const std::filesystem::path& folder, std::int64_t ahead_us = 0);

/// Runs of simulated mines with their truth, joined.
class MergedRuns {
 public:
  explicit MergedRuns(std::vector<TrueRun> runs);

  [[nodiscard]] const RunGroups& groups() const { return *groups_; }
  [[nodiscard]] const std::string& name(std::size_t run) const { return names_[run]; }
  [[nodiscard]] double cpu_s() const { return cpu_s_; }  ///< of joining

  /// The places of the local maps of a group, and of one of its runs, with the true ones.
  [[nodiscard]] std::vector<PosePair> places(const RunGroup& group) const;
  [[nodiscard]] std::vector<PosePair> places(const RunGroup& group, const PlacedRun& run) const;
  /// The errors of the links of a join against the true poses, in plan and along the directions
  /// that they fix to 0.1 m [m].
  [[nodiscard]] std::vector<double> link_errors_m(const RunGroup& group, const RunJoin& join) const;

 private:
  [[nodiscard]] Pose2 true_pose(const RunGroup& group, int map) const;

  std::vector<std::string> names_;
  std::vector<Trajectory> truths_;
  std::unique_ptr<RunGroups> groups_;
  double cpu_s_ = 0.0;
};

}  // namespace adit
