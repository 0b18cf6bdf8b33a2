// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <set>
#include <string>
#include <string_view>

#include "common/process_list/process_list.hpp"
#include "procs/supervisor/managed_process.hpp"

namespace adit {

/// Runs the processes of one computer. No descendant of these outlives it, however it ends, see
/// ChildProcess; if a watcher is killed, its descendants become children of this process
/// (PR_SET_CHILD_SUBREAPER), which kills them. Times are steady_us().
class ProcessManager {
 public:
  /// Whether a remote command is running.
  using RemoteReady = std::function<bool(const std::string& id)>;

  ProcessManager(const ProcessList& list, const ProcessManagerOptions& options);
  /// Stops all processes, dependents before their dependencies, and waits until they have ended.
  ~ProcessManager();
  ProcessManager(const ProcessManager&) = delete;
  ProcessManager& operator=(const ProcessManager&) = delete;

  /// Replaces the list. A changed process keeps its old command until it is restarted; a removed
  /// process continues until it is stopped, and is then erased.
  void update_list(const ProcessList& list);

  /// Null if the command is not local.
  [[nodiscard]] ManagedProcess* find(const std::string& id);
  [[nodiscard]] const std::list<ManagedProcess>& processes() const { return processes_; }

  void on_message(std::string_view channel, std::int64_t now_us);

  /// Must be called every few 10 ms. Returns whether any state has changed.
  bool advance(std::int64_t now_us, const RemoteReady& remote_ready);

  /// Updates the resource usage of each process and kills orphans; about once per second.
  void measure(std::int64_t now_us);

 private:
  [[nodiscard]] bool dependencies_ready(const ManagedProcess& process,
                                        const RemoteReady& remote_ready);
  [[nodiscard]] bool is_local(const ListedCommand& command) const;
  void erase_removed();
  void kill_strays(const ProcessTable& table) const;
  [[nodiscard]] bool any_runs() const;

  ProcessManagerOptions options_;
  std::set<std::string> removed_;        // ids removed from the list
  std::list<ManagedProcess> processes_;  // in list order, removed ones first
};

}  // namespace adit
