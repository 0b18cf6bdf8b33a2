// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/messages/result.hpp"

namespace adit {

/// A program with its arguments and its additional environment variables.
struct CommandLine {
  std::vector<std::pair<std::string, std::string>> environment;
  std::vector<std::string> arguments;  ///< not empty; the program first

  friend bool operator==(const CommandLine&, const CommandLine&) = default;
};

/// Splits a line into words by the quoting rules of a shell (POSIX, 2.2 Quoting): blanks,
/// backslash, single and double quotes. Words `NAME=value` before the program are environment
/// variables. Other shell syntax (variables, patterns, pipes) is not interpreted: `;`, `|`, `$`
/// etc. are literal. Rejects an unterminated quote, a trailing backslash, a NUL byte and a line
/// without a program.
Result<CommandLine> parse_command_line(std::string_view text);

}  // namespace adit
