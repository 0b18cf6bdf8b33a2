// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include <Eigen/Core>

namespace adit {

/// The middles of the occupied cells of a map as ROS's map_server has it, in the frame of the map
/// [m], row by row from the top. `yaml` names the image beside it, a binary PGM of 8 bits. Throws
/// std::runtime_error, one line that names the file, for what cannot be read.
std::vector<Eigen::Vector2d> read_occupied_cells(const std::filesystem::path& yaml);

}  // namespace adit
