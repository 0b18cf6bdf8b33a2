// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "tools/cloud/point_cloud.hpp"

namespace adit {

/// Reads a PLY, PCD or XYZ file, told apart by how they begin and by the ending of the name. Throws
/// std::runtime_error, one line with the file and the line or byte, for one that is missing, empty,
/// damaged or something else, and for one without a single usable point.
PointCloud read_cloud_file(const std::filesystem::path& file);

}  // namespace adit
