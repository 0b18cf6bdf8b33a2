// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/process_list/process_list.hpp"

namespace adit {

/// The list as a text that parse_process_list reads to the same list. Attributes at their defaults
/// are left out, so that a list without additions of ours is one that procman reads. Groups are
/// opened anew where they change, so that the order of the commands stays.
std::string to_text(const ProcessList& list);

}  // namespace adit
