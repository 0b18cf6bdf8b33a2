// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/process_list/process_list.hpp"

namespace adit {

/// What is wrong with a list as a whole, one line; empty where nothing is: a name that two commands
/// or scripts have, no program, a dependency that does not exist or leads in a circle, a script
/// that means what is not there or runs itself.
std::string what_is_wrong(const ProcessList& list);

}  // namespace adit
