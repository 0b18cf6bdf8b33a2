// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <csignal>
#include <optional>
#include <string>
#include <vector>

namespace adit {

/// A process is alive while it publishes on this channel at this rate.
struct LivenessSignal {
  std::string channel;
  double rate_hz = 1.0;  ///< minimum rate, wall clock time

  friend bool operator==(const LivenessSignal&, const LivenessSignal&) = default;
};

/// A process answers its input: while messages keep coming on `inputs`, it publishes on `channel`.
struct AnswerRule {
  std::string channel;
  std::vector<std::string> inputs;
  double timeout_s = 10.0;  ///< with input and without an answer, wall clock time
  /// It may have nothing to say for any time after its start: input counts from its first answer.
  bool late = false;

  friend bool operator==(const AnswerRule&, const AnswerRule&) = default;
};

/// A program managed by a supervisor: procman's attributes and the extensions below.
struct ListedCommand {
  std::string id;      ///< unique in the list; no slashes
  std::string exec;    ///< `A=B program "an argument"`, see CommandLine; run without a shell
  std::string deputy;  ///< name of the supervisor that runs it
  std::string group;   ///< "outer/inner"; empty: none
  bool auto_respawn = false;
  int stop_signal = SIGINT;
  double stop_time_allowed_s = 7.0;  ///< from stop_signal to SIGKILL

  // Extensions of procman's attributes.
  std::vector<std::string> depends_on;  ///< commands that must be running before it starts
  std::optional<int> restart_limit;     ///< consecutive restarts; none: unlimited
  std::optional<LivenessSignal> alive;  ///< none: running as soon as it is started
  double start_timeout_s = 10.0;        ///< until it must be alive, and answer its input
  std::optional<AnswerRule> answer;     ///< none: it may ignore its input

  friend bool operator==(const ListedCommand&, const ListedCommand&) = default;
};

/// The commands that a script action applies to.
struct ScriptTarget {
  enum class Kind { kEverything, kGroup, kCommand };
  Kind kind = Kind::kEverything;
  std::string name;  ///< name of the group or command

  friend bool operator==(const ScriptTarget&, const ScriptTarget&) = default;
};

enum class AwaitedStatus { kNone, kRunning, kStopped };

/// One action of a script.
struct ScriptAction {
  enum class Kind { kStart, kStop, kRestart, kWaitTime, kWaitStatus, kRunScript };
  Kind kind = Kind::kStart;
  ScriptTarget target = {};                      ///< of start, stop, restart and kWaitStatus
  AwaitedStatus awaited = AwaitedStatus::kNone;  ///< status to wait for
  int wait_ms = 0;                               ///< of kWaitTime
  std::optional<double> timeout_s = {};          ///< of waits for a status; none: the default
  std::string script = {};                       ///< of kRunScript

  friend bool operator==(const ScriptAction&, const ScriptAction&) = default;
};

struct ProcessScript {
  std::string name;
  std::vector<ScriptAction> actions;

  friend bool operator==(const ProcessScript&, const ProcessScript&) = default;
};

/// The commands of all computers and the scripts. A supervisor runs only commands of its list.
struct ProcessList {
  std::vector<ListedCommand> commands;  ///< in file order
  std::vector<ProcessScript> scripts;

  [[nodiscard]] const ListedCommand* find(const std::string& id) const;
  [[nodiscard]] const ProcessScript* find_script(const std::string& name) const;

  /// The ids of the commands of a target; a group includes its nested groups.
  [[nodiscard]] std::vector<std::string> ids_of(const ScriptTarget& target) const;

  friend bool operator==(const ProcessList&, const ProcessList&) = default;
};

/// Difference between two versions of a process list: ids, in the order of the lists.
struct ProcessListDiff {
  std::vector<std::string> changed;  ///< in any attribute
  std::vector<std::string> added;
  std::vector<std::string> removed;
  bool scripts = false;
};

ProcessListDiff diff(const ProcessList& before, const ProcessList& after);

/// Human-readable: a line per kind of change, or "no changes".
std::string text_of(const ProcessListDiff& change);

}  // namespace adit
