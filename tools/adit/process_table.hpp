// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace adit {

/// The rows that a supervisor answers to "ps" (see its rows_of) as a table for a terminal, with a
/// heading. The columns of group and trouble are left out where nothing stands in them.
std::string process_table_text(std::string_view rows);

}  // namespace adit
