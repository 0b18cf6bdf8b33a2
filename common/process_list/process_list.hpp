// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <csignal>
#include <optional>
#include <string>
#include <vector>

namespace adit {

/// By what a process shows that it works: it publishes.
struct LivenessSignal {
  std::string channel;
  double rate_hz = 1.0;  ///< at least, by the wall clock

  friend bool operator==(const LivenessSignal&, const LivenessSignal&) = default;
};

/// A program that is to be kept running, as procman describes it and with what we add.
struct ListedCommand {
  std::string id;      ///< unique in the list, without slashes
  std::string exec;    ///< `A=B program "an argument"`, see CommandLine; no shell is asked
  std::string deputy;  ///< on which computer: the name of its supervisor
  std::string group;   ///< "outer/inner"; empty: none
  bool auto_respawn = false;
  int stop_signal = SIGINT;
  double stop_time_allowed_s = 7.0;  ///< from that signal to SIGKILL

  // What procman does not have.
  std::vector<std::string> depends_on;  ///< commands that must work before this one starts
  std::optional<int> restart_limit;     ///< restarts without a good time between; none: no limit
  std::optional<LivenessSignal> alive;  ///< none: it works as soon as it runs
  double start_timeout_s = 10.0;        ///< until it must show that it is alive

  friend bool operator==(const ListedCommand&, const ListedCommand&) = default;
};

/// Which commands a script means.
struct ScriptTarget {
  enum class Kind { kEverything, kGroup, kCommand };
  Kind kind = Kind::kEverything;
  std::string name;  ///< of the group or command

  friend bool operator==(const ScriptTarget&, const ScriptTarget&) = default;
};

enum class AwaitedStatus { kNone, kRunning, kStopped };

/// One step of a script.
struct ScriptAction {
  enum class Kind { kStart, kStop, kRestart, kWaitTime, kWaitStatus, kRunScript };
  Kind kind = Kind::kStart;
  ScriptTarget target = {};                      ///< of start, stop, restart and a wait for status
  AwaitedStatus awaited = AwaitedStatus::kNone;  ///< of these, what to wait for
  int wait_ms = 0;                               ///< of a wait for time
  std::optional<double> timeout_s = {};          ///< of a wait for status; none: the default
  std::string script = {};                       ///< to run

  friend bool operator==(const ScriptAction&, const ScriptAction&) = default;
};

struct ProcessScript {
  std::string name;
  std::vector<ScriptAction> actions;

  friend bool operator==(const ProcessScript&, const ProcessScript&) = default;
};

/// What is to run, on all computers, and what may be done to it. Only what stands here is ever run.
struct ProcessList {
  std::vector<ListedCommand> commands;  ///< in the order of the file
  std::vector<ProcessScript> scripts;

  [[nodiscard]] const ListedCommand* find(const std::string& id) const;
  [[nodiscard]] const ProcessScript* find_script(const std::string& name) const;

  /// The names of the commands that are meant, those of a group with the groups within it.
  [[nodiscard]] std::vector<std::string> ids_of(const ScriptTarget& target) const;

  friend bool operator==(const ProcessList&, const ProcessList&) = default;
};

/// What a list that was read again says otherwise than before; names, in the order of the lists.
struct ProcessListDiff {
  std::vector<std::string> changed;  ///< in anything: command line, computer, limits
  std::vector<std::string> added;
  std::vector<std::string> removed;
  bool scripts = false;
};

ProcessListDiff diff(const ProcessList& before, const ProcessList& after);

/// For people: a line for each kind of change, or that there is none.
std::string text_of(const ProcessListDiff& change);

}  // namespace adit
