// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "common/grid/occupancy_grid.hpp"
#include "common/picture/map_picture.hpp"
#include "common/pose_graph/g2o_file.hpp"
#include "common/pose_graph/map_graph.hpp"
#include "common/sensing/laser_mount.hpp"
#include "tools/map/full_map.hpp"
#include "tools/map/run_record.hpp"

namespace adit {

/// The record of lazy data association as a table with tabs, a line for each decision in the order
/// in which they were made: when, what, on which closure of which local maps, where the newer one
/// is taken to lie in the frame of the older one, and why. The first line names the columns.
std::string association_table(const FullMap& map);

/// Writes the pose graph as graph.g2o, local maps by their ids and all constraints in force, and
/// the record of decisions as associations.tsv: a line each, in the order in which they were made.
/// Throws std::runtime_error where a file cannot be written.
void write_graph_files(const FullMap& map, const std::filesystem::path& folder);

/// Local maps by their ids, and all constraints in force.
G2oGraph g2o_of(const MapGraph& graph);

/// The pose graph to be drawn: revoked is what was chosen once and is not in force at the end.
GraphPicture graph_picture(const FullMap& map);

struct MapFilesOptions {
  std::string title;
  OccupancyGridParams grid;
  Lasers lasers;
  bool draw_graph = false;
};

/// Writes trajectory.tum and odometry.tum, map.png, map.pgm and map.yaml into a folder. False where
/// the poses are so far apart that the grid would not hold them; the trajectories are written all
/// the same. Throws std::runtime_error where a file cannot be written.
bool write_map_files(const FullMap& map, const RunRecord& record, const MapFilesOptions& options,
                     const std::filesystem::path& folder);

}  // namespace adit
