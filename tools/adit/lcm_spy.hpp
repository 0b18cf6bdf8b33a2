// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace adit {

/// Program to execute, with additions to its environment.
struct SpyCommand {
  std::vector<std::string> arguments;  ///< the first one is the path of the program
  std::map<std::string, std::string> environment;
};

/// Returns the command that starts lcm-spy, or with a log lcm-logplayer-gui, such that it decodes
/// the message types of this project: the class path includes every lcmtypes_*.jar and
/// lcmspy_plugins_*.jar in `../share/java` relative to `program_folder`, the folder of `adit` in
/// the build or installation tree. Unknown Java options are ignored, because Debian's lcm-spy
/// passes options that current Java versions reject. `search_path` has the format of PATH. Throws
/// std::runtime_error with one line that names the missing packages.
SpyCommand lcm_spy_command(const std::filesystem::path& program_folder,
                           std::string_view search_path,
                           const std::optional<std::filesystem::path>& log);

/// Replaces this process by that program. Throws std::runtime_error.
[[noreturn]] void run_lcm_spy(const std::optional<std::filesystem::path>& log);

}  // namespace adit
