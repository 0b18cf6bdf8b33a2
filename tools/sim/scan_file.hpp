// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "common/types/cloud.hpp"

namespace adit {

/// Writes a 3D scan as an LCM log of its messages (.lcmlog), or its points only, in the frame level
/// (.ply). Throws std::runtime_error for another extension, or if the file cannot be written.
void write_scan(const Cloud& cloud, const std::filesystem::path& file);

}  // namespace adit
