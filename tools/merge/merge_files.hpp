// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "common/grid/occupancy_grid.hpp"
#include "common/sensing/laser_mount.hpp"
#include "tools/map/full_map.hpp"
#include "tools/merge/map_changes.hpp"
#include "tools/merge/run_groups.hpp"

namespace adit {

/// Names and lasers of all runs, in the order given.
struct RunInfo {
  std::string name;
  Lasers lasers;
};

/// The runs by the sessions of the map: for each path of a FullMap the index in `group.runs`.
std::vector<std::size_t> runs_of_paths(const RunGroup& group);

/// The grid of all runs, or of one of them only (index in `group.runs`), each scan by the lasers of
/// its robot. False if the poses exceed the size of the grid.
bool insert_runs(const FullMap& map, const RunGroup& group, const std::vector<RunInfo>& runs,
                 OccupancyGrid& grid);
bool insert_run(const FullMap& map, const RunGroup& group, std::size_t placed,
                const std::vector<RunInfo>& runs, OccupancyGrid& grid);

/// Writes trajectory_N.tum, N the number of the run.
void write_trajectories(const FullMap& map, const RunGroup& group,
                        const std::filesystem::path& folder);

/// Writes changes.png and changes.tsv. Runs of a change are those of the group.
void write_changes(const std::vector<MapChange>& changes, const OccupancyGrid& grid,
                   const RunGroup& group, const std::filesystem::path& folder);

/// Writes map.journal: the joined local maps and the decisions on their loop closures. False, and
/// nothing written, if the lasers of the robots differ: a map has one set.
bool write_joined_journal(const RunGroup& group, const std::vector<RunInfo>& runs,
                          const std::filesystem::path& folder);

/// "appeared", "vanished" or "differs".
const char* kind_text(MapChange::Kind kind);

}  // namespace adit
