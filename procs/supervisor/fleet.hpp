// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "procs/supervisor/management/script_run.hpp"
#include "procs/supervisor/management/stop_sequence.hpp"
#include "procs/supervisor/process_manager.hpp"
#include "procs/supervisor/procman/remote_deputies.hpp"
#include "procs/supervisor/supervisor_setup.hpp"

namespace adit {

/// All processes of the list, local and remote, by id. Local processes are controlled directly,
/// remote ones by orders to their deputies.
class Fleet {
 public:
  Fleet(const SupervisorSetup& setup, const RestartBackoff& backoff);

  /// Starts, stops or restarts processes for a script or a control request. Dependents are stopped
  /// before their dependencies. Throws std::invalid_argument, without any effect, if an id is not
  /// in the list, or if a process is remote and this supervisor is not in charge.
  void change(const ScriptChange& change, std::int64_t now_us);

  /// Applies the reloaded list of the setup; `before` is the previous list. Changed local processes
  /// that run are restarted, removed ones are stopped.
  void update_list(const ProcessList& before, std::int64_t now_us);

  [[nodiscard]] ProcessState process_state(const std::string& id, std::int64_t now_us);

  /// Whether a stop of the process waits for its dependents to stop.
  [[nodiscard]] bool stop_is_pending(const std::string& id) const {
    return stop_sequence_.is_pending(id);
  }

  void on_message(std::string_view channel, std::int64_t now_us);
  void on_message(const ProcmanOutput& output) {
    remote_output_.on_message(output, setup_.list, setup_.deputy);
  }
  /// Output of a process; null for a remote process without received output.
  [[nodiscard]] const OutputLog* output(const std::string& id);

  /// Returns whether the state of any local process has changed.
  bool advance(std::int64_t now_us);

  [[nodiscard]] const SupervisorSetup& setup() const { return setup_; }
  [[nodiscard]] ProcessManager& process_manager() { return process_manager_; }
  [[nodiscard]] const ProcessManager& process_manager() const { return process_manager_; }
  [[nodiscard]] RemoteDeputies& remotes() { return remotes_; }

 private:
  void require_change_allowed(const std::string& id);
  void start(const std::string& id);
  void stop(const StopSequence::Stop& stop, std::int64_t now_us);
  void enqueue_stop(const ListedCommand& command, bool and_start, std::int64_t now_us);
  void issue_due_stops(std::int64_t now_us);

  const SupervisorSetup& setup_;
  ProcessManager process_manager_;
  RemoteDeputies remotes_;
  RemoteOutput remote_output_;
  StopSequence stop_sequence_;
};

/// Runs scripts on a fleet, one at a time, and stores the failure of the last one.
class FleetScript {
 public:
  /// Replaces a running script. Throws std::invalid_argument if there is no such script.
  void begin(const std::string& name, const ProcessList& list, double timeout_s);
  /// Executes the actions that are due. Returns whether any process was changed.
  bool advance(Fleet& fleet, std::int64_t now_us);
  /// Ends a running script with `reason` as its failure. Returns whether a script was running.
  bool abort(const std::string& reason);

  /// Why the last script failed; empty if it did not.
  [[nodiscard]] const std::string& failure() const { return failure_; }

 private:
  std::optional<ScriptRun> run_;
  std::string failure_;
};

}  // namespace adit
