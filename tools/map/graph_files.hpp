// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "common/picture/graph_picture.hpp"
#include "common/pose_graph/g2o_file.hpp"
#include "common/pose_graph/map_graph.hpp"
#include "tools/map/whole_map.hpp"

namespace adit {

/// Writes the pose graph as graph.g2o, local maps by their ids and all constraints in force, and
/// the record of decisions as associations.tsv: a line each, in the order in which they were made.
/// Throws std::runtime_error where a file cannot be written.
void write_graph_files(const WholeMap& map, const std::filesystem::path& folder);

/// Local maps by their ids, and all constraints in force.
G2oGraph g2o_of(const MapGraph& graph);

/// The pose graph to be drawn: revoked is what was chosen once and is not in force at the end.
GraphPicture graph_picture(const WholeMap& map);

}  // namespace adit
