// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/keeper.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "procs/supervisor/keeping/ordered_stops.hpp"
#include "procs/supervisor/os/wall_time.hpp"

namespace adit {
namespace {

constexpr auto kLook = std::chrono::milliseconds(10);

}  // namespace

Keeper::Keeper(const ProcessList& list, const KeeperOptions& options) : options_(options) {
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  relist(list);
}

Keeper::~Keeper() {
  OrderedStops stops;
  for (const KeptProcess& process : processes_) stops.add(process.command(), false, steady_us());
  const auto is_ending = [this](const std::string& id) { return find(id)->life().runs(); };
  while (anything_runs()) {
    for (const auto& stop : stops.take_due(steady_us(), is_ending)) {
      find(stop.id)->stop(steady_us());
    }
    for (KeptProcess& process : processes_) process.advance(steady_us(), false);
    std::this_thread::sleep_for(kLook);
  }
}

bool Keeper::keeps(const ListedCommand& command) const { return command.deputy == options_.deputy; }

void Keeper::relist(const ProcessList& list) {
  std::list<KeptProcess> before;
  before.swap(processes_);
  gone_.clear();
  for (const ListedCommand& command : list.commands) {
    if (!keeps(command)) continue;
    const auto old = std::ranges::find_if(
        before, [&](const KeptProcess& process) { return process.command().id == command.id; });
    if (old == before.end()) {
      processes_.emplace_back(command, options_);
    } else {
      old->list_as(command);
      processes_.splice(processes_.end(), before, old);
    }
  }
  for (const KeptProcess& process : before) gone_.insert(process.command().id);
  processes_.splice(processes_.begin(), before);
}

void Keeper::forget_gone() {
  processes_.remove_if([this](const KeptProcess& process) {
    return gone_.contains(process.command().id) && !process.life().runs() &&
           !process.life().wanted();
  });
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
  if (!gone_.empty()) forget_gone();
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

bool Keeper::anything_runs() const {
  return std::ranges::any_of(processes_,
                             [](const KeptProcess& process) { return process.life().runs(); });
}

}  // namespace adit
