// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include <Eigen/Core>

namespace adit {

/// Centres of the occupied cells of a map in the format of ROS's map_server, in the frame of the
/// map [m], row by row from the top. `yaml` names the image in the same folder, a binary PGM of 8
/// bits. Throws std::runtime_error, one line with the name of the file, for an unreadable file.
std::vector<Eigen::Vector2d> read_occupied_cells(const std::filesystem::path& yaml);

}  // namespace adit
