// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "procs/mapping/mapping.hpp"

namespace adit {

/// A run in a map of several.
struct PlacedRun {
  std::size_t run = 0;  ///< by the order in which runs were added
  int first_map = 0;    ///< its local maps
  int maps = 0;
  int first_session = 0;
  int sessions = 0;
  std::optional<RunJoin> join;  ///< how it came to the others; empty for the first
};

/// Runs that are one map. The frame is that of the first run.
struct RunGroup {
  std::unique_ptr<Mapping> map;
  std::vector<PlacedRun> runs;
};

/// A join that was rejected: of the map of one run with that of another, each with all that were
/// joined to it by then.
struct RejectedJoin {
  std::size_t to_run = 0;  ///< first run of the map
  std::size_t run = 0;     ///< first run of the map that was to be joined to it
  RunJoin join;
};

/// Joins runs into as few maps as their evidence allows: one for each mine.
class RunGroups {
 public:
  explicit RunGroups(const RunJoinParams& params) : params_(params) {}

  /// Adds the restored map of a run; it has local maps.
  void add(std::unique_ptr<Mapping> map);
  /// Tries again what was rejected, as maps have grown. The map of most runs comes first, of most
  /// local maps among these. `progress` gets the share that is done.
  void finish(const std::function<void(double)>& progress = {});

  [[nodiscard]] const std::vector<RunGroup>& groups() const { return groups_; }
  /// In the order of the attempts.
  [[nodiscard]] const std::vector<RejectedJoin>& rejected() const { return rejected_; }

 private:
  bool try_join(RunGroup& group, RunGroup& other);

  RunJoinParams params_;
  std::vector<RunGroup> groups_;
  std::vector<RejectedJoin> rejected_;
  std::size_t runs_ = 0;
};

}  // namespace adit
