// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace adit {

/// The text between quotation marks, for a message about content of a file, a command line or the
/// network. Control characters, directional formatting of Unicode and bytes that are not UTF-8 are
/// written as \\xNN, so that they neither act on a terminal nor end the message; of a long text the
/// beginning and the number of bytes.
std::string quote(std::string_view text, char mark = '\'');

/// The same on a message that may have such content in it, without quotes: one line of at most
/// about 2,000 bytes. What a program prints passes through this.
std::string message_line(std::string_view message);

/// The same on several lines of any length: keeps line ends and tabs.
std::string printable_lines(std::string_view text);

/// Prints `program: message` on standard error, as one line.
void print_error(std::string_view program, std::string_view message);

}  // namespace adit
