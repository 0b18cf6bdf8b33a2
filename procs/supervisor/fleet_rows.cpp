// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/fleet_rows.hpp"

#include <sstream>
#include <string_view>

namespace adit {
namespace {

std::string_view state_of(const ProcmanStatus& status) {
  return status.pid > 0 ? "running" : "stopped";
}

/// What it waits for, or its trouble.
std::string note_on(Fleet& fleet, const KeptProcess& process, std::int64_t now_us) {
  if (fleet.stops_later(process.command().id)) return "stops after what depends on it";
  if (process.life().state() != LifeState::kWaiting) return process.life().trouble();
  std::string note;
  for (const std::string& id : process.command().depends_on) {
    if (fleet.standing(id, now_us) == Standing::kWorking) continue;
    note.append(note.empty() ? "for " : ", ").append(id);
  }
  return note;
}

std::string row(Fleet& fleet, const ListedCommand& command, std::int64_t now_us) {
  std::ostringstream out;
  out << command.id << '\t' << command.deputy << '\t' << command.group << '\t';
  if (const KeptProcess* const process = fleet.keeper().find(command.id)) {
    out << name_of(process->life().state()) << '\t' << process->pid() << '\t'
        << process->use().cpu_cores << '\t' << process->use().memory_bytes << '\t'
        << process->life().restarts() << '\t' << note_on(fleet, *process, now_us);
  } else if (const auto status = fleet.remotes().status(command.id, now_us)) {
    out << state_of(*status) << '\t' << status->pid << '\t' << status->cpu_cores << '\t'
        << status->memory_bytes << "\t0\t";
  } else {
    out << "unknown\t0\t0\t0\t0\tnothing was heard from " << command.deputy << " for five seconds";
  }
  return out.str();
}

}  // namespace

std::string rows_of(Fleet& fleet, std::int64_t now_us) {
  std::string text;
  for (const ListedCommand& command : fleet.site().list.commands) {
    text += row(fleet, command, now_us) + "\n";
  }
  return text;
}

}  // namespace adit
