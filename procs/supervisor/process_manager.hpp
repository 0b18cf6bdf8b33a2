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

/// Keeps the processes of one computer. Nothing that these start outlives it, however it ends: see
/// ChildProcess; and should one of the watchers be killed, those that it watched over come to this
/// process (PR_SET_CHILD_SUBREAPER), which kills them. Times are those of steady_us().
class ProcessManager {
 public:
  /// Whether a command of another computer works.
  using ReadyElsewhere = std::function<bool(const std::string& id)>;

  ProcessManager(const ProcessList& list, const ProcessManagerOptions& options);
  /// Stops all, what depends on others before these, and waits for that.
  ~ProcessManager();
  ProcessManager(const ProcessManager&) = delete;
  ProcessManager& operator=(const ProcessManager&) = delete;

  /// Keeps what this list says from now on. A process that the list has otherwise runs on as it was
  /// until it is restarted; one that it has no more runs on until it is stopped, and is forgotten.
  void update_list(const ProcessList& list);

  /// Null where the command is none of this computer's.
  [[nodiscard]] ManagedProcess* find(const std::string& id);
  [[nodiscard]] const std::list<ManagedProcess>& processes() const { return processes_; }

  void on_message(std::string_view channel, std::int64_t now_us);

  /// To be called every few hundredths of a second. Whether anything has changed.
  bool advance(std::int64_t now_us, const ReadyElsewhere& ready_elsewhere);

  /// How much each process uses; about once a second.
  void measure(std::int64_t now_us);

 private:
  [[nodiscard]] bool dependencies_ready(const ManagedProcess& process,
                                        const ReadyElsewhere& ready_elsewhere);
  [[nodiscard]] bool is_local(const ListedCommand& command) const;
  void erase_removed();
  void kill_strays(const ProcessTable& table) const;
  [[nodiscard]] bool any_runs() const;

  ProcessManagerOptions options_;
  std::set<std::string> removed_;        // from the list
  std::list<ManagedProcess> processes_;  // in the order of the list, those that are gone first
};

}  // namespace adit
