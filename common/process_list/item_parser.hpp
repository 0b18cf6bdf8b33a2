// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/process_list/process_list.hpp"
#include "common/process_list/tokenizer.hpp"

namespace adit {

/// Throws ConfigError unless the token can be the name of a command, group or script: not empty,
/// without slashes and control characters, at most 200 bytes.
void require_name(const TokenStream& tokens, const ListToken& token);

/// The same for names with slashes between, of which there are at most sixteen.
void require_group_path(const TokenStream& tokens, const TextPosition& position,
                        const std::string& path);

/// Reads what follows on `cmd`: the name and the attributes in braces. `group` is where it stands.
/// Throws ConfigError.
ListedCommand parse_listed_command(TokenStream& tokens, const std::string& group);

/// Reads what follows on `script`: the name and the steps in braces. Throws ConfigError.
ProcessScript parse_process_script(TokenStream& tokens);

}  // namespace adit
