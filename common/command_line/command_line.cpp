// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/command_line/command_line.hpp"

#include <CLI/CLI.hpp>

namespace adit {

std::unique_ptr<CLI::App> make_command_line(const std::string& description,
                                            const std::string& program) {
  return std::make_unique<CLI::App>(description, program);
}

CLI::App* add_command(CLI::App& parent, const std::string& name, const std::string& description) {
  return parent.add_subcommand(name, description);
}

std::optional<int> parse_command_line(CLI::App& app, int argc, const char* const* argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& answer) {
    return app.exit(answer);
  }
  return std::nullopt;
}

}  // namespace adit
