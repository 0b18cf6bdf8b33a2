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

/// The commands of other computers: their state as reported by their deputies, and the orders for
/// them. Orders are repeated, to tolerate lost messages, and contain only commands that were
/// started or stopped explicitly. Times are those of a monotonic clock [µs].
class RemoteDeputies {
 public:
  /// Contains the commands of all deputies except `own`.
  RemoteDeputies(const ProcessList& list, const std::string& own);

  /// Replaces the list. The state and order of a command are retained if its deputy is unchanged.
  void update_list(const ProcessList& list);

  void on_message(const ProcmanInfo& info, std::int64_t now_us);
  void on_message(std::string_view channel, std::int64_t now_us);

  [[nodiscard]] bool has(const std::string& id) const { return commands_.contains(id); }
  void start(const std::string& id) { commands_.at(id).request = Request::kRun; }
  void stop(const std::string& id) { commands_.at(id).request = Request::kStop; }
  void restart(const std::string& id) { commands_.at(id).request = Request::kRestart; }

  /// The orders for each deputy. A command without a status from its deputy is omitted.
  std::vector<ProcmanOrders> orders(const std::string& sheriff, std::int64_t utime);

  /// kChanging if the order is not fulfilled yet or the deputy has timed out.
  [[nodiscard]] ProcessState process_state(const std::string& id, std::int64_t now_us) const;
  /// Whether it is ordered to stop or restart and still runs by its last status.
  [[nodiscard]] bool is_ending(const std::string& id, std::int64_t now_us) const;
  /// The newest status; nothing if it is older than five seconds.
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
    std::optional<ProcmanOrder> order;  // is repeated
  };

  static Command begin(const ListedCommand& command);
  static void decide(Command& command);

  std::string own_deputy_;
  std::map<std::string, Command> commands_;
};

/// Received output of remote processes: the last lines of each. Only processes of the list are
/// stored, which bounds the memory.
class RemoteOutput {
 public:
  /// Ignores output of the deputy `own`, and of processes that the list assigns to another deputy.
  void on_message(const ProcmanOutput& output, const ProcessList& list, const std::string& own);

  /// Null if no output was received.
  [[nodiscard]] const OutputLog* find(const std::string& id) const;

 private:
  std::map<std::string, OutputLog> logs_;  // by process
};

}  // namespace adit
