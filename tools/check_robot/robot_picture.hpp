// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "tools/check_robot/robot_config.hpp"

namespace adit {

/// Draws the robot from above, x to the right: body, wheels, lasers, what they see and where the
/// robot is blind, and the distance within which it stops. A PNG. Throws FileError.
void write_robot_png(const std::filesystem::path& path, const std::string& title,
                     const RobotConfig& robot);

}  // namespace adit
