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

/// A program to be started, with what is added to its environment.
struct SpyCommand {
  std::vector<std::string> arguments;  ///< the first is the path of the program
  std::map<std::string, std::string> environment;
};

/// How to start lcm-spy, or with a log the window of the log player, so that it decodes our types:
/// with every lcmtypes_*.jar and lcmspy_plugins_*.jar of `../share/java` from the folder that the
/// program `adit` is in (that of the build or of the installation) on its class path, and with the
/// Java options of Debian's package, some of which today's Java refuses, tolerated.
/// `search_path` is that of programs, as in PATH. Throws std::runtime_error with one line that says
/// what to install.
SpyCommand lcm_spy_command(const std::filesystem::path& program_folder,
                           std::string_view search_path,
                           const std::optional<std::filesystem::path>& log);

/// Becomes that program. Throws std::runtime_error.
[[noreturn]] void run_lcm_spy(const std::optional<std::filesystem::path>& log);

}  // namespace adit
