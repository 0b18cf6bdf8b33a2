// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/command_line/command_line.hpp"

#include <algorithm>
#include <cmath>

#include <CLI/CLI.hpp>

#include "common/config/number_text.hpp"
#include "common/text/message_text.hpp"

namespace adit {

std::unique_ptr<CLI::App> make_command_line(const std::string& description,
                                            const std::string& program) {
  return std::make_unique<CLI::App>(description, program);
}

CLI::App* add_command(CLI::App& parent, const std::string& name, const std::string& description) {
  return parent.add_subcommand(name, description);
}

CLI::Validator number_in(const Bounds& bounds) {
  Bounds allowed = bounds;
  allowed.min = std::max(allowed.min, -kOptionNumberMax);
  if (std::isinf(allowed.max)) allowed.max = kOptionNumberMax;
  const auto check = [allowed](const std::string& text) {
    const auto number = parse_number<double>(text.starts_with('+') ? text.substr(1) : text);
    if (number && allowed.allow(*number)) return std::string();
    return quote(text) + " is not a number in the range " + allowed.text();
  };
  return CLI::Validator(check, "");
}

std::optional<double> option_number(std::string_view text) {
  const auto number = parse_number<double>(text);
  return number && std::abs(*number) <= kOptionNumberMax ? number : std::nullopt;
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
