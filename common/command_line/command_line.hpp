// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace adit {

/// An empty command line with --help.
std::unique_ptr<CLI::App> make_command_line(const std::string& description,
                                            const std::string& program);

/// Adds an empty sub-command with --help.
CLI::App* add_command(CLI::App& parent, const std::string& name, const std::string& description);

/// Parses the arguments, and runs the callbacks of the commands. Returns the exit code if --help or
/// --version has been answered on standard output. Throws CLI::ParseError.
std::optional<int> parse_command_line(CLI::App& app, int argc, const char* const* argv);

}  // namespace adit
