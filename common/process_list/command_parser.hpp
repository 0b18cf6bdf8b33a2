// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/process_list/process_list.hpp"
#include "common/process_list/token_stream.hpp"

namespace adit {

/// Reads what follows on `cmd`: the name and the attributes in braces. `group` is where it stands.
/// Throws ConfigError.
ListedCommand parse_listed_command(TokenStream& tokens, const std::string& group);

}  // namespace adit
