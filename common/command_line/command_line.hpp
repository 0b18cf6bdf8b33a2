// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "common/config/bounds.hpp"

namespace CLI {
class App;
class Validator;
}  // namespace CLI

namespace adit {

/// An empty command line with --help.
std::unique_ptr<CLI::App> make_command_line(const std::string& description,
                                            const std::string& program);

/// Adds an empty sub-command with --help.
CLI::App* add_command(CLI::App& parent, const std::string& name, const std::string& description);

/// Largest magnitude of a number on a command line, where no other is stated.
inline constexpr double kOptionNumberMax = 1e9;

/// Check of an option that is a number: finite, at most kOptionNumberMax unless the bounds have a
/// maximum, and within the bounds. All numbers of all options are checked by it: those of CLI11
/// accept nan.
CLI::Validator number_in(const Bounds& bounds = {});

/// The finite number that spans the text, at most kOptionNumberMax; nothing for other text. For
/// options with several numbers in one text.
std::optional<double> option_number(std::string_view text);

/// Parses the arguments, and runs the callbacks of the commands. Returns the exit code if --help or
/// --version has been answered on standard output. Throws CLI::ParseError.
std::optional<int> parse_command_line(CLI::App& app, int argc, const char* const* argv);

}  // namespace adit
