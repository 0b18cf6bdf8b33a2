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

/// Names of the worlds that are built in: the files of sim/worlds without `.yaml`, sorted.
std::vector<std::string> built_in_worlds();

/// The description behind a name on the command line: `random`, a built-in world, or the path of a
/// world file (.yaml) or of a mesh (.obj, .ply, .dae, ..). The seed replaces that of the file.
/// A mesh file named in a world file is looked for beside that file. Throws ConfigError, and
/// std::runtime_error for a name that is none of these, with what there is.
WorldDescription find_world(const std::string& name, std::optional<int> seed = {});

/// The whole description as a world file that loads again.
std::string to_world_file(const WorldDescription& description);

}  // namespace adit
