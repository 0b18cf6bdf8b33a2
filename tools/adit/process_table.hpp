// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace adit {

/// Formats the answer of a supervisor to "ps" (one row per line, tab-separated columns) as a table
/// with a heading. The group column is omitted if it is empty.
std::string process_table_text(std::string_view rows);

}  // namespace adit
