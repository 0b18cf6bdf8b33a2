// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "procs/supervisor/os/process_table.hpp"

namespace adit {

/// What a process and all that it started use of the computer.
struct ProcessUse {
  double cpu_cores = 0.0;  ///< since the last time it was asked for; 1: one core is busy
  std::int64_t address_bytes = 0;
  std::int64_t memory_bytes = 0;
  bool waits_for_disk = false;  ///< in a sleep that no signal ends, not even SIGKILL
};

/// Tells it from one look at the table to the next.
class UsageMeter {
 public:
  /// Of the descendants of a process, without itself.
  ProcessUse measure(const ProcessTable& table, pid_t ancestor, std::int64_t now_us);

 private:
  std::map<pid_t, double> cpu_s_;
  std::optional<std::int64_t> last_us_;
};

}  // namespace adit
