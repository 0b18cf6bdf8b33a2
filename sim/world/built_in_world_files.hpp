// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace adit {

/// A world file of sim/worlds, embedded at build time.
struct WorldFileText {
  std::string name;  ///< without `.yaml`
  std::string text;
  std::string drive;  ///< the waypoints in `<name>_drive.txt`; empty if there is no such file
};

/// Sorted by name. Made by cmake/embed_worlds.cmake.
std::vector<WorldFileText> built_in_world_files();

}  // namespace adit
