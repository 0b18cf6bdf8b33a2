// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <sys/types.h>

namespace adit {

/// Processes that descend from one, at whatever depth, and whose executable has the name, in
/// ascending order. One whose parent ended no longer descends from it. Processes that end
/// meanwhile, or of which nothing may be known, are left out.
std::vector<pid_t> descendants_named(pid_t ancestor, const std::string& executable);

/// Who started a process: its parent, or where that is an adit-watch, the supervisor that has it. 0
/// where nothing may be known.
pid_t starter_of(pid_t pid);

/// Sends the signal to all processes `executable` that were started beside this one: that descend
/// from its starter. To none where that is init, from which everybody descends. Returns how many it
/// was sent to.
int signal_siblings(const std::string& executable, int signal);

}  // namespace adit
