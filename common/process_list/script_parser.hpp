// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/process_list/process_list.hpp"
#include "common/process_list/token_stream.hpp"

namespace adit {

/// Reads what follows on `script`: the name and the steps in braces. Throws ConfigError.
ProcessScript parse_process_script(TokenStream& tokens);

}  // namespace adit
