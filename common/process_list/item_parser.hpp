// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/process_list/process_list.hpp"
#include "common/process_list/tokenizer.hpp"

namespace adit {

/// Throws ConfigError unless the token is a valid name of a command, group or script: 1 to 200
/// bytes, no slashes or control characters.
void require_name(const TokenStream& tokens, const ListToken& token);

/// Throws ConfigError unless `path` is at most sixteen valid names separated by slashes.
void require_group_path(const TokenStream& tokens, const TextPosition& position,
                        const std::string& path);

/// Parses what follows `cmd`: the name and the attributes in braces. `group` is the path of the
/// enclosing group. Throws ConfigError.
ListedCommand parse_listed_command(TokenStream& tokens, const std::string& group);

/// Parses what follows `script`: the name and the actions in braces. Throws ConfigError.
ProcessScript parse_process_script(TokenStream& tokens);

}  // namespace adit
