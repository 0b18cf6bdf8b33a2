// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "tools/eval/trajectory.hpp"

namespace adit {

/// T_world_body as a simulator has put it into an LCM log on channel TRUTH, its planar part. A time
/// that comes again or is earlier than one before is left out. Throws std::runtime_error where the
/// log cannot be read or holds no truth.
Trajectory read_truth(const std::filesystem::path& log);

}  // namespace adit
