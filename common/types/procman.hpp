// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace adit {

/// A command of procman (cmd_t).
struct ProcmanCommand {
  std::string id;
  std::string exec;
  std::string group;
  bool auto_respawn = false;
  int stop_signal = 0;               ///< 0: SIGINT
  double stop_time_allowed_s = 0.0;  ///< 0: 7 s

  friend bool operator==(const ProcmanCommand&, const ProcmanCommand&) = default;
};

/// Status of a command (cmd_status_t).
struct ProcmanStatus {
  ProcmanCommand command;
  std::int32_t pid = 0;  ///< 0: not running
  std::int32_t run_id = 0;
  std::int32_t wait_status = 0;    ///< of the last exit, as returned by waitpid
  double cpu_cores = 0.0;          ///< 1: one core fully used
  std::int64_t address_bytes = 0;  ///< address space of the process and its children
  std::int64_t memory_bytes = 0;

  friend bool operator==(const ProcmanStatus&, const ProcmanStatus&) = default;
};

/// Load of a computer.
struct HostLoad {
  double cpu_share = 0.0;  ///< 0 to 1
  std::int64_t memory_bytes = 0;
  std::int64_t memory_free_bytes = 0;
  std::int64_t swap_bytes = 0;
  std::int64_t swap_free_bytes = 0;

  friend bool operator==(const HostLoad&, const HostLoad&) = default;
};

/// Status of a deputy (deputy_info_t, PM_INFO).
struct ProcmanInfo {
  std::int64_t utime = 0;  ///< wall clock [µs since the epoch], as in all of these
  std::string deputy;
  HostLoad load;
  std::vector<ProcmanStatus> commands;

  friend bool operator==(const ProcmanInfo&, const ProcmanInfo&) = default;
};

/// Desired state of a command (cmd_desired_t).
struct ProcmanOrder {
  ProcmanCommand command;
  std::int32_t run_id = 0;  ///< a value other than that of the last run requests a restart
  bool stop = false;        ///< true: must not run

  friend bool operator==(const ProcmanOrder&, const ProcmanOrder&) = default;
};

/// Desired state of the commands of a deputy (orders_t, PM_ORDERS).
struct ProcmanOrders {
  std::int64_t utime = 0;
  std::string deputy;
  std::string sheriff;
  std::vector<ProcmanOrder> orders;

  friend bool operator==(const ProcmanOrders&, const ProcmanOrders&) = default;
};

/// Output of commands (output_t, PM_OUTPUT).
struct ProcmanOutput {
  struct Text {
    std::string id;
    std::string text;
    friend bool operator==(const Text&, const Text&) = default;
  };

  std::int64_t utime = 0;
  std::string deputy;
  std::vector<Text> texts;

  friend bool operator==(const ProcmanOutput&, const ProcmanOutput&) = default;
};

/// Requests PM_INFO from every deputy (discovery_t, PM_DISCOVER).
struct ProcmanDiscovery {
  std::int64_t utime = 0;
  std::string from;
  std::int64_t nonce = 0;

  friend bool operator==(const ProcmanDiscovery&, const ProcmanDiscovery&) = default;
};

}  // namespace adit
