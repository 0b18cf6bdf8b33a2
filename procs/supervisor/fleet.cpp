// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/fleet.hpp"

#include <sstream>
#include <stdexcept>

namespace adit {
namespace {

using Kind = ScriptAction::Kind;

std::string_view state_of(const ProcmanStatus& status) {
  return status.pid > 0 ? "running" : "stopped";
}

}  // namespace

Fleet::Fleet(const SupervisorSite& site, const RestartPace& pace)
    : site_(site),
      keeper_(site.list, {site.deputy, site.watcher, pace}),
      remotes_(site.list, site.deputy) {}

void Fleet::require_may_change(const std::string& id) {
  const ListedCommand* const command = site_.list.find(id);
  if (!command) throw std::invalid_argument("there is no process \"" + id + "\" in the list");
  if (!site_.in_charge && command->deputy != site_.deputy) {
    throw std::invalid_argument("\"" + id + "\" runs on " + command->deputy +
                                ", and this supervisor is not in charge");
  }
}

void Fleet::change(const ScriptChange& change, std::int64_t now_us) {
  for (const std::string& id : change.ids) require_may_change(id);
  for (const std::string& id : change.ids) this->change(change.kind, id, now_us);
}

void Fleet::change(Kind kind, const std::string& id, std::int64_t now_us) {
  if (KeptProcess* const process = keeper_.find(id)) {
    if (kind == Kind::kStart) process->start();
    if (kind == Kind::kStop) process->stop(now_us);
    if (kind == Kind::kRestart) process->restart(now_us);
  } else {
    if (kind == Kind::kStart) remotes_.start(id);
    if (kind == Kind::kStop) remotes_.stop(id);
    if (kind == Kind::kRestart) remotes_.restart(id);
  }
}

Standing Fleet::standing(const std::string& id, std::int64_t now_us) {
  const KeptProcess* const process = keeper_.find(id);
  if (!process) return remotes_.standing(id, now_us);
  if (process->works()) return Standing::kWorking;
  const LifeState state = process->life().state();
  const bool rests = state == LifeState::kStopped || state == LifeState::kFailed;
  return rests ? Standing::kStopped : Standing::kBetween;
}

void Fleet::heard(std::string_view channel, std::int64_t now_us) {
  keeper_.heard(channel, now_us);
  remotes_.heard(channel, now_us);
}

bool Fleet::advance(std::int64_t now_us) {
  return keeper_.advance(now_us, [&](const std::string& id) {
    return remotes_.standing(id, now_us) == Standing::kWorking;
  });
}

std::string Fleet::rows(std::int64_t now_us) {
  std::string text;
  for (const ListedCommand& command : site_.list.commands) text += row(command, now_us) + "\n";
  return text;
}

/// What it waits for, or its trouble.
std::string Fleet::note_on(const KeptProcess& process, std::int64_t now_us) {
  if (process.life().state() != LifeState::kWaiting) return process.life().trouble();
  std::string note;
  for (const std::string& id : process.command().depends_on) {
    if (standing(id, now_us) == Standing::kWorking) continue;
    note.append(note.empty() ? "for " : ", ").append(id);
  }
  return note;
}

std::string Fleet::row(const ListedCommand& command, std::int64_t now_us) {
  std::ostringstream out;
  out << command.id << '\t' << command.deputy << '\t' << command.group << '\t';
  if (const KeptProcess* const process = keeper_.find(command.id)) {
    out << name_of(process->life().state()) << '\t' << process->pid() << '\t'
        << process->use().cpu_cores << '\t' << process->use().memory_bytes << '\t'
        << process->life().restarts() << '\t' << note_on(*process, now_us);
  } else if (const auto status = remotes_.status(command.id, now_us)) {
    out << state_of(*status) << '\t' << status->pid << '\t' << status->cpu_cores << '\t'
        << status->memory_bytes << "\t0\t";
  } else {
    out << "unknown\t0\t0\t0\t0\tnothing was heard from " << command.deputy << " for five seconds";
  }
  return out.str();
}

}  // namespace adit
