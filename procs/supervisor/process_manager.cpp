// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/process_manager.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/service/wall_time.hpp"
#include "procs/supervisor/management/stop_sequence.hpp"

namespace adit {
namespace {

constexpr auto kPollPeriod = std::chrono::milliseconds(10);

}  // namespace

ProcessManager::ProcessManager(const ProcessList& list, const ProcessManagerOptions& options)
    : options_(options) {
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  update_list(list);
}

ProcessManager::~ProcessManager() {
  StopSequence stops;
  for (const ManagedProcess& process : processes_) stops.add(process.command(), false, steady_us());
  const auto is_ending = [this](const std::string& id) { return find(id)->lifecycle().runs(); };
  while (any_runs()) {
    for (const auto& stop : stops.take_due(steady_us(), is_ending)) {
      find(stop.id)->stop(steady_us());
    }
    for (ManagedProcess& process : processes_) process.advance(steady_us(), false);
    std::this_thread::sleep_for(kPollPeriod);
  }
}

bool ProcessManager::is_local(const ListedCommand& command) const {
  return command.deputy == options_.deputy;
}

void ProcessManager::update_list(const ProcessList& list) {
  std::list<ManagedProcess> before;
  before.swap(processes_);
  removed_.clear();
  for (const ListedCommand& command : list.commands) {
    if (!is_local(command)) continue;
    const auto old = std::ranges::find_if(
        before, [&](const ManagedProcess& process) { return process.command().id == command.id; });
    if (old == before.end()) {
      processes_.emplace_back(command, options_);
    } else {
      old->update_command(command);
      processes_.splice(processes_.end(), before, old);
    }
  }
  for (const ManagedProcess& process : before) removed_.insert(process.command().id);
  processes_.splice(processes_.begin(), before);
}

void ProcessManager::erase_removed() {
  processes_.remove_if([this](const ManagedProcess& process) {
    return removed_.contains(process.command().id) && !process.lifecycle().runs() &&
           !process.lifecycle().should_run();
  });
}

ManagedProcess* ProcessManager::find(const std::string& id) {
  const auto found = std::ranges::find_if(
      processes_, [&](const ManagedProcess& process) { return process.command().id == id; });
  return found == processes_.end() ? nullptr : &*found;
}

void ProcessManager::on_message(std::string_view channel, std::int64_t now_us) {
  for (ManagedProcess& process : processes_) process.on_message(channel, now_us);
}

bool ProcessManager::advance(std::int64_t now_us, const RemoteReady& remote_ready) {
  bool changed = false;
  for (ManagedProcess& process : processes_) {
    const bool may_start = dependencies_ready(process, remote_ready);
    if (process.advance(now_us, may_start)) changed = true;
  }
  if (!removed_.empty()) erase_removed();
  return changed;
}

bool ProcessManager::dependencies_ready(const ManagedProcess& process,
                                        const RemoteReady& remote_ready) {
  return std::ranges::all_of(process.command().depends_on, [&](const std::string& id) {
    const ManagedProcess* const local = find(id);
    return local ? local->is_ready() : remote_ready(id);
  });
}

void ProcessManager::measure(std::int64_t now_us) {
  const ProcessTable table = ProcessTable::read();
  for (ManagedProcess& process : processes_) process.measure(table, now_us);
  kill_strays(table);
}

/// A child of this process that is not a watcher is an orphan of a watcher that was killed.
void ProcessManager::kill_strays(const ProcessTable& table) const {
  std::set<pid_t> strays = table.children_of(getpid());
  for (const ManagedProcess& process : processes_) strays.erase(process.watcher());
  for (const pid_t stray : strays) {
    for (const pid_t pid : table.descendants_of(stray)) kill(pid, SIGKILL);
    kill(stray, SIGKILL);
    waitpid(stray, nullptr, WNOHANG);
  }
}

bool ProcessManager::any_runs() const {
  return std::ranges::any_of(
      processes_, [](const ManagedProcess& process) { return process.lifecycle().runs(); });
}

}  // namespace adit
