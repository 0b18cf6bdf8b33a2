// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace adit {

/// What can be known of a mesh file before it is read, so that none fills the memory. Throws
/// std::runtime_error, one line with the file, for one that is missing, empty or too large, for a
/// PLY without a header, and for a PLY or a Collada file (.dae) that announces more of anything
/// than its bytes can hold.
void check_mesh_file(const std::filesystem::path& file);

}  // namespace adit
