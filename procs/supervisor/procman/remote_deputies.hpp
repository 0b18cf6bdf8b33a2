// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/process_list/process_list.hpp"
#include "common/types/procman.hpp"
#include "procs/supervisor/management/output_log.hpp"
#include "procs/supervisor/management/publish_rate_monitor.hpp"
#include "procs/supervisor/management/script_run.hpp"

namespace adit {

/// The commands of other computers: how they are, as their deputies say, and how they are to be, as
/// the one in charge says. Orders are repeated, so that a lost message does no harm, and name only
/// commands about which somebody has decided; the others are left as they are. Times are those of a
/// clock that is never put back [µs].
class RemoteDeputies {
 public:
  /// All commands but those of `own`.
  RemoteDeputies(const ProcessList& list, const std::string& own);

  /// Those of this list from now on. What is known and ordered of a command stays, as long as it is
  /// the same computer's.
  void update_list(const ProcessList& list);

  void on_message(const ProcmanInfo& info, std::int64_t now_us);
  void on_message(std::string_view channel, std::int64_t now_us);

  [[nodiscard]] bool has(const std::string& id) const { return commands_.contains(id); }
  void start(const std::string& id) { commands_.at(id).request = Request::kRun; }
  void stop(const std::string& id) { commands_.at(id).request = Request::kStop; }
  void restart(const std::string& id) { commands_.at(id).request = Request::kRestart; }

  /// What each deputy is to be told. A command whose deputy was not heard yet waits.
  std::vector<ProcmanOrders> orders(const std::string& sheriff, std::int64_t utime);

  /// Between, where it is on its way to what was ordered, or its deputy is silent.
  [[nodiscard]] ProcessState process_state(const std::string& id, std::int64_t now_us) const;
  /// Whether it still runs and is to stop, as far as is heard.
  [[nodiscard]] bool is_ending(const std::string& id, std::int64_t now_us) const;
  /// The newest; nothing where the deputy has been silent for five seconds.
  [[nodiscard]] std::optional<ProcmanStatus> status(const std::string& id,
                                                    std::int64_t now_us) const;

 private:
  enum class Request { kNone, kRun, kRestart, kStop };

  struct Command {
    ListedCommand listed;
    PublishRateMonitor rate;
    std::optional<ProcmanStatus> status;
    std::int64_t received_us = 0;
    Request request = Request::kNone;
    std::optional<ProcmanOrder> order;  // that is repeated
  };

  static Command begin(const ListedCommand& command);
  static void decide(Command& command);

  std::string own_deputy_;
  std::map<std::string, Command> commands_;
};

/// What the processes of other computers print, as far as it was heard: of each the last lines, as
/// for those of this computer. Their names are those of the list, so nobody can fill the memory.
class RemoteOutput {
 public:
  /// What comes from another computer than the list says is left out, and so is what is `own`.
  void on_message(const ProcmanOutput& output, const ProcessList& list, const std::string& own);

  /// Null where nothing was heard.
  [[nodiscard]] const OutputLog* find(const std::string& id) const;

 private:
  std::map<std::string, OutputLog> logs_;  // by process
};

}  // namespace adit
