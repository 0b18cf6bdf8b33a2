// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/process_list/process_list.hpp"

namespace adit {

/// The list as text, such that parse_process_list returns the same list. Attributes with default
/// values are omitted, so that procman can read a list without Adit's extensions. A group block is
/// written for each command, which preserves the order of the commands.
std::string to_text(const ProcessList& list);

}  // namespace adit
