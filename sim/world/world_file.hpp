// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/world/world_description.hpp"

namespace adit {

/// Names of the built-in worlds: the files of sim/worlds without `.yaml`, sorted.
std::vector<std::string> built_in_worlds();

/// The description of a world by name: `random`, `random_level` (RandomMineParams::level),
/// `two_levels`, `grade:PERCENT` (parse_grade_tunnel), `narrow:METRES` (parse_narrow_tunnel), a
/// built-in world, or the path of a world file (.yaml) or of a mesh (.obj, .ply, .dae, ..). `seed`
/// replaces that of the file. The path of a mesh in a world file is relative to that file. Throws
/// ConfigError, and std::runtime_error with the known names for an unknown name.
WorldDescription find_world(const std::string& name, std::optional<int> seed = {});

/// The complete description as a world file.
std::string to_world_file(const WorldDescription& description);

}  // namespace adit
