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

/// All processes of the list, on this computer and on others, by their names.
class Fleet {
 public:
  Fleet(const SupervisorSetup& setup, const RestartBackoff& backoff);

  /// Does to each what a script or a terminal wants. Throws std::invalid_argument, and does
  /// nothing, where a name is not in the list, or a process is another computer's and this
  /// supervisor is not in charge. Of several that are to stop, what depends on others goes first.
  void change(const ScriptChange& change, std::int64_t now_us);

  /// The list of the site is another than `before`: what runs here and has changed is stopped and
  /// started as it is now, what is gone is stopped.
  void update_list(const ProcessList& before, std::int64_t now_us);

  [[nodiscard]] ProcessState process_state(const std::string& id, std::int64_t now_us);

  /// Whether it is to be stopped, once what depends on it is.
  [[nodiscard]] bool stop_is_pending(const std::string& id) const {
    return stop_sequence_.is_pending(id);
  }

  void on_message(std::string_view channel, std::int64_t now_us);
  void on_message(const ProcmanOutput& output) {
    remote_output_.on_message(output, setup_.list, setup_.deputy);
  }
  /// What a process has printed; null where it is another computer's of which nothing was heard.
  [[nodiscard]] const OutputLog* output(const std::string& id);

  /// Whether anything has changed on this computer.
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
  void stop_those_due(std::int64_t now_us);

  const SupervisorSetup& setup_;
  ProcessManager process_manager_;
  RemoteDeputies remotes_;
  RemoteOutput remote_output_;
  StopSequence stop_sequence_;
};

/// The script that runs on a fleet, one at a time, and how the last one fared.
class FleetScript {
 public:
  /// Takes the place of one that runs. Throws std::invalid_argument where there is no such script.
  void begin(const std::string& name, const ProcessList& list, double timeout_s);
  /// Does what its turn has come for. Whether anything was changed.
  bool advance(Fleet& fleet, std::int64_t now_us);
  /// Ends it, with that as its failure. Whether one ran.
  bool end(const std::string& why);

  /// Why the last one ended before its end; empty where it did not.
  [[nodiscard]] const std::string& failure() const { return failure_; }

 private:
  std::optional<ScriptRun> run_;
  std::string failure_;
};

}  // namespace adit
