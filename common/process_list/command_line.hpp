// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/messages/result.hpp"

namespace adit {

/// A program with its arguments, and what is added to its environment.
struct CommandLine {
  std::vector<std::pair<std::string, std::string>> environment;
  std::vector<std::string> arguments;  ///< the program first; at least that

  friend bool operator==(const CommandLine&, const CommandLine&) = default;
};

/// Divides a line as a shell would (POSIX, 2.2 Quoting): blanks between words, backslash, single
/// and double quotes. Words `NAME=value` before the program go into its environment. Nothing else
/// of a shell is known: no variable, no pattern, no pipe; `;`, `|`, `$` and the like are
/// themselves. Refused: a quote that does not end, a backslash at the end, a NUL, no program.
Result<CommandLine> parse_command_line(std::string_view text);

}  // namespace adit
