// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/keeper.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <set>
#include <thread>

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "procs/supervisor/os/wall_time.hpp"

namespace adit {
namespace {

constexpr auto kLook = std::chrono::milliseconds(10);

}  // namespace

Keeper::Keeper(const ProcessList& list, const KeeperOptions& options) {
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  for (const ListedCommand& command : list.commands) {
    if (command.deputy != options.deputy) continue;
    processes_.emplace_back(command, options.pace, options.watcher);
  }
}

Keeper::~Keeper() {
  stop_all(steady_us());
  while (anything_runs()) {
    advance(steady_us(), [](const std::string&) { return false; });
    std::this_thread::sleep_for(kLook);
  }
}

KeptProcess* Keeper::find(const std::string& id) {
  const auto found = std::ranges::find_if(
      processes_, [&](const KeptProcess& process) { return process.command().id == id; });
  return found == processes_.end() ? nullptr : &*found;
}

void Keeper::heard(std::string_view channel, std::int64_t now_us) {
  for (KeptProcess& process : processes_) {
    const auto& alive = process.command().alive;
    if (alive && alive->channel == channel) process.heard(now_us);
  }
}

bool Keeper::advance(std::int64_t now_us, const WorksElsewhere& works_elsewhere) {
  bool changed = false;
  for (KeptProcess& process : processes_) {
    const bool may_start = dependencies_work(process, works_elsewhere);
    if (process.advance(now_us, may_start)) changed = true;
  }
  return changed;
}

bool Keeper::dependencies_work(const KeptProcess& process, const WorksElsewhere& works_elsewhere) {
  return std::ranges::all_of(process.command().depends_on, [&](const std::string& id) {
    const KeptProcess* const here = find(id);
    return here ? here->works() : works_elsewhere(id);
  });
}

void Keeper::measure(std::int64_t now_us) {
  const ProcessTable table = ProcessTable::read();
  for (KeptProcess& process : processes_) process.measure(table, now_us);
  kill_strays(table);
}

/// Only whoever lost its watcher is a child of ours without being one.
void Keeper::kill_strays(const ProcessTable& table) const {
  std::set<pid_t> strays = table.children_of(getpid());
  for (const KeptProcess& process : processes_) strays.erase(process.watcher());
  for (const pid_t stray : strays) {
    for (const pid_t pid : table.descendants_of(stray)) kill(pid, SIGKILL);
    kill(stray, SIGKILL);
    waitpid(stray, nullptr, WNOHANG);
  }
}

void Keeper::stop_all(std::int64_t now_us) {
  for (KeptProcess& process : processes_) process.stop(now_us);
}

bool Keeper::anything_runs() const {
  return std::ranges::any_of(processes_,
                             [](const KeptProcess& process) { return process.life().runs(); });
}

}  // namespace adit
