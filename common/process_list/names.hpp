// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/process_list/token_stream.hpp"

namespace adit {

/// Throws ConfigError unless the token can be the name of a command, group or script: not empty,
/// without slashes and control characters, at most 200 bytes.
void require_name(const TokenStream& tokens, const ListToken& token);

/// The same for names with slashes between, of which there are at most sixteen.
void require_names(const TokenStream& tokens, const TextPlace& place, const std::string& path);

}  // namespace adit
