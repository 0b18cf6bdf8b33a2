// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string_view>

#include "tools/eval/trajectory.hpp"

namespace adit {

/// The trajectory format of the TUM RGB-D benchmark: one line `time x y z qx qy qz qw` per pose, in
/// seconds, metres and a unit quaternion; `#` starts a comment. The number of digits is fixed, so
/// that the same trajectory gives the same bytes.
void write_tum(std::ostream& out, const Trajectory& trajectory);
/// Throws std::runtime_error with the path if the file cannot be written.
void write_tum(const std::filesystem::path& path, const Trajectory& trajectory);

/// Reads the planar part (x, y, yaw). A malformed line, or a time that does not increase, throws
/// std::runtime_error with `name:line: reason`.
Trajectory read_tum(std::istream& in, std::string_view name);
Trajectory read_tum(const std::filesystem::path& path);

}  // namespace adit
