// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "common/cloud/cloud.hpp"

namespace adit {

/// Writes the points of a cloud, in level, as binary PLY (little endian, float). Lines, the place
/// of the laser and beams without return are not in it. Throws std::runtime_error where the file
/// cannot be written.
void write_ply(const Cloud& cloud, const std::filesystem::path& file);

}  // namespace adit
