// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "common/grid/occupancy_grid.hpp"
#include "common/picture/map_picture.hpp"
#include "common/pose_graph/g2o_file.hpp"
#include "common/pose_graph/map_graph.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/types/association.hpp"
#include "tools/map/doubt_list.hpp"
#include "tools/map/full_map.hpp"
#include "tools/map/run_record.hpp"

namespace adit {

/// "accepted", "left open", "revoked", "re-accepted" or "revised".
const char* decision_text(const Association& association);

/// Decisions of lazy data association as tab-separated values, one line per decision, in order of
/// time: time, decision, loop closure, local maps, chosen alternative, T_older_newer,
/// log-likelihoods and reason. The first line has the names of the columns.
std::string association_table(const FullMap& map);

/// Writes graph.g2o and associations.tsv (association_table). Throws std::runtime_error if a file
/// cannot be written.
void write_graph_files(const FullMap& map, const std::filesystem::path& folder);

/// The pose graph: local maps by their ids, and all accepted constraints.
G2oGraph g2o_of(const MapGraph& graph);

/// The pose graph for a picture. Revoked edges are alternatives that were accepted at some time and
/// are not at the end.
GraphPicture graph_picture(const FullMap& map);

/// A picture shows each pose of the paths, or of those that are too long every `pose_step`-th.
std::size_t pose_step(const FullMap& map);
inline constexpr std::size_t kPosesDrawn = 200'000;

/// Title and paths of all sessions for a picture.
MapPicture map_picture(const FullMap& map, const std::string& title);

struct MapFilesOptions {
  std::string title;
  OccupancyGridParams grid;
  Lasers lasers;
  bool draw_graph = false;
};

/// Writes trajectory.tum, odometry.tum, map.png, map.pgm and map.yaml into a folder. False if the
/// poses exceed the size of the grid; only the trajectories are written then. Throws
/// std::runtime_error if a file cannot be written.
bool write_map_files(const FullMap& map, const RunRecord& record,
                     const std::vector<DoubtfulStretch>& stretches, const MapFilesOptions& options,
                     const std::filesystem::path& folder);

}  // namespace adit
