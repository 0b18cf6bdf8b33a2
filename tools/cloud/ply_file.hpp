// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "common/types/cloud.hpp"
#include "tools/cloud/point_cloud.hpp"

namespace adit {

/// The vertices of a PLY file (ascii, binary of either byte order): x, y and z of any type;
/// everything else in it is passed over. No more is allocated than the bytes that are there can
/// fill. Throws std::runtime_error, one line with the line or the byte, for anything else.
PointCloud read_ply(std::span<const std::uint8_t> bytes);

/// Writes the points of a cloud, in level, as binary PLY (little endian, float). Lines, the place
/// of the laser and beams without return are not in it. Throws std::runtime_error where the file
/// cannot be written.
void write_ply(const Cloud& cloud, const std::filesystem::path& file);

}  // namespace adit
