// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "procs/supervisor/control/control_server.hpp"
#include "procs/supervisor/fleet.hpp"
#include "procs/supervisor/process_manager.hpp"

namespace adit {

/// The first problem of the local processes: a failed or pausing process, one that was restarted
/// and has not run stably since, or a log file that cannot be written. Empty if there is none.
std::string first_problem(const ProcessManager& process_manager);

/// Whether any local process is in the state kFailed.
bool any_failed(const ProcessManager& process_manager);

/// "3 of 12 processes run".
std::string running_count_text(const ProcessManager& process_manager);

/// A line per process, in list order, fields separated by tabs: id, deputy, group, state, process
/// id, CPU usage [cores], memory [bytes], restarts (all, recent), note (error or what the process
/// waits for).
std::string status_rows(Fleet& fleet, std::int64_t now_us);

/// Output of a process and, with `follow`, its further output; the fleet must then outlive the
/// response. For a remote process, output received since the start of this supervisor. Throws
/// std::invalid_argument if the process is not in the list.
ControlResponse logs_response(Fleet& fleet, const std::string& id, bool follow);

}  // namespace adit
