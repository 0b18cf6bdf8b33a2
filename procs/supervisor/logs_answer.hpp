// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "procs/supervisor/fleet.hpp"
#include "procs/supervisor/terminal/terminal_server.hpp"

namespace adit {

/// What a process has printed and, with `follow`, what it prints from now on; the fleet must
/// outlive the answer then. Of another computer's that is what was heard since this supervisor
/// started. Throws std::invalid_argument where the process is not in the list.
TerminalAnswer logs_answer(Fleet& fleet, const std::string& id, bool follow);

}  // namespace adit
