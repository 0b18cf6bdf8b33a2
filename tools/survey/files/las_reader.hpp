// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>

#include "tools/survey/files/las_file.hpp"

namespace adit {

/// Calls `visit` with each point of a file that `write_las` wrote: LAS 1.4 of format 6 with the
/// attributes scan, sd_plan and sd_z. Times are not read: utime is 0. Throws FileError with the
/// path and the reason for another file, a damaged one, or a number that is not finite.
void read_las(const std::filesystem::path& path, const std::function<void(const LasPoint&)>& visit);

}  // namespace adit
