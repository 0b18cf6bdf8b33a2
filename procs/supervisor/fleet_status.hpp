// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "procs/supervisor/control/control_server.hpp"
#include "procs/supervisor/fleet.hpp"
#include "procs/supervisor/process_manager.hpp"

namespace adit {

/// What is not as it should be with the processes of this computer, the first of it; empty where
/// all is well.
std::string first_problem(const ProcessManager& process_manager);

/// Whether some process was given up.
bool any_failed(const ProcessManager& process_manager);

/// "3 of 12 processes run".
std::string running_count_text(const ProcessManager& process_manager);

/// For people: a line for each process, in the order of the list, its words divided by tabs:
/// name, deputy, group, state, process id, cores in use, memory [bytes], restarts, trouble.
std::string status_rows(Fleet& fleet, std::int64_t now_us);

/// What a process has printed and, with `follow`, what it prints from now on; the fleet must
/// outlive the answer then. Of another computer's that is what was heard since this supervisor
/// started. Throws std::invalid_argument where the process is not in the list.
ControlResponse logs_response(Fleet& fleet, const std::string& id, bool follow);

}  // namespace adit
