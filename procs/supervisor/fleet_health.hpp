// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "procs/supervisor/keeper.hpp"

namespace adit {

/// What is not as it should be with the processes of this computer, the first of it; empty where
/// all is well.
std::string complaint_about(const Keeper& keeper);

/// Whether some process was given up.
bool any_given_up(const Keeper& keeper);

/// "3 of 12 processes run".
std::string count_of_running(const Keeper& keeper);

}  // namespace adit
