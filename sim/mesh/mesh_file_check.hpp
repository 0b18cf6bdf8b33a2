// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace adit {

/// Checks a mesh file before it is read, so that a damaged file cannot exhaust the memory. Throws
/// std::runtime_error, one line with the file name, for a file that is missing, empty or too large,
/// for a PLY file without a header, and for a PLY or Collada (.dae) file that announces more
/// elements than its size allows.
void check_mesh_file(const std::filesystem::path& file);

}  // namespace adit
