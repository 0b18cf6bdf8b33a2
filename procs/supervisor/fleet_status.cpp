// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/fleet_status.hpp"

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "common/text/message_text.hpp"

namespace adit {

std::string first_problem(const ProcessManager& process_manager) {
  for (const ManagedProcess& process : process_manager.processes()) {
    const LifecycleState state = process.lifecycle().state();
    if (state == LifecycleState::kFailed || state == LifecycleState::kBackoff) {
      return process.command().id + " is " + std::string(name_of(state)) + ": " +
             process.lifecycle().error();
    }
  }
  for (const ManagedProcess& process : process_manager.processes()) {
    const ProcessLifecycle& lifecycle = process.lifecycle();
    if (!lifecycle.should_run() || lifecycle.restarts() == 0) continue;
    return process.command().id + " was restarted: " + lifecycle.error();
  }
  for (const ManagedProcess& process : process_manager.processes()) {
    if (!process.log_error().empty()) return process.log_error();
  }
  return {};
}

bool any_failed(const ProcessManager& process_manager) {
  return std::ranges::any_of(process_manager.processes(), [](const ManagedProcess& process) {
    return process.lifecycle().state() == LifecycleState::kFailed;
  });
}

std::string running_count_text(const ProcessManager& process_manager) {
  const auto running =
      std::ranges::count_if(process_manager.processes(), [](const ManagedProcess& process) {
        return process.lifecycle().state() == LifecycleState::kRunning;
      });
  return std::to_string(running) + " of " + std::to_string(process_manager.processes().size()) +
         " processes run";
}

namespace {

std::string_view state_of(const ProcmanStatus& status) {
  return status.pid > 0 ? "running" : "stopped";
}

/// What the process waits for, or its error.
std::string status_note(Fleet& fleet, const ManagedProcess& process, std::int64_t now_us) {
  if (fleet.stop_is_pending(process.command().id)) return "waits for its dependents to stop";
  if (process.lifecycle().state() != LifecycleState::kWaiting) return process.lifecycle().error();
  std::string note;
  for (const std::string& id : process.command().depends_on) {
    if (fleet.process_state(id, now_us) == ProcessState::kRunning) continue;
    note.append(note.empty() ? "for " : ", ").append(id);
  }
  return note;
}

/// All restarts, and in parentheses those without a stable run in between, which count for the
/// restart limit.
std::string restarts_text(const ProcessLifecycle& lifecycle) {
  const std::string total = std::to_string(lifecycle.total_restarts());
  const int recent = lifecycle.restarts();
  return recent > 0 ? total + " (" + std::to_string(recent) + ")" : total;
}

std::string status_row(Fleet& fleet, const ListedCommand& command, std::int64_t now_us) {
  std::ostringstream out;
  out << command.id << '\t' << command.deputy << '\t' << command.group << '\t';
  if (const ManagedProcess* const process = fleet.process_manager().find(command.id)) {
    out << name_of(process->lifecycle().state()) << '\t' << process->pid() << '\t'
        << process->usage().cpu_cores << '\t' << process->usage().memory_bytes << '\t'
        << restarts_text(process->lifecycle()) << '\t' << status_note(fleet, *process, now_us);
  } else if (const auto status = fleet.remotes().status(command.id, now_us)) {
    out << state_of(*status) << '\t' << status->pid << '\t' << status->cpu_cores << '\t'
        << status->memory_bytes << "\t-\t";  // procman's status has no restarts
  } else {
    out << "unknown\t0\t0\t0\t-\tno status from " << command.deputy << " for five seconds";
  }
  return out.str();
}

}  // namespace

std::string status_rows(Fleet& fleet, std::int64_t now_us) {
  std::string text;
  for (const ListedCommand& command : fleet.setup().list.commands) {
    text += status_row(fleet, command, now_us) + "\n";
  }
  return text;
}

namespace {

constexpr std::size_t kResponseBytesMax = 2'000'000;  // more than the capacity of an OutputLog

/// Output from line `next` on. Finds the log by id each time, since reloading the list can remove a
/// process.
std::string text_since(Fleet& fleet, const std::string& id, std::int64_t& next) {
  const OutputLog* const output = fleet.output(id);
  if (!output) return {};
  const OutputLines unread = output->since(next, kResponseBytesMax);
  next = unread.next;
  return text_of(unread);
}

}  // namespace

ControlResponse logs_response(Fleet& fleet, const std::string& id, bool follow) {
  const ListedCommand* const listed = fleet.setup().list.find(id);
  if (!listed) throw std::invalid_argument("no process " + quote(id, '"') + " in the list");
  std::int64_t next = 0;
  ControlResponse response{text_since(fleet, id, next)};
  if (!fleet.output(id)) response.text = "(no output received from " + listed->deputy + ")\n";
  if (!follow) return response;
  response.more = [&fleet, id, next]() mutable { return text_since(fleet, id, next); };
  return response;
}

}  // namespace adit
