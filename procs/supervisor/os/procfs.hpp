// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include <sys/types.h>

#include "common/types/procman.hpp"

namespace adit {

/// A process as /proc/PID/stat has it.
struct ProcessEntry {
  pid_t pid = 0;
  pid_t parent = 0;
  /// Z: it is over, and its parent has not asked; D: it waits for the disk.
  char state = '?';
  double cpu_s = 0.0;
  std::int64_t address_bytes = 0;
  std::int64_t memory_bytes = 0;
};

/// From a line of /proc/PID/stat; nothing where it is none. The name may hold anything.
std::optional<ProcessEntry> parse_process_entry(std::string_view stat);

/// The processes of this computer. No snapshot: it is read while they live.
class ProcessTable {
 public:
  static ProcessTable read(const std::filesystem::path& proc = "/proc");
  explicit ProcessTable(std::map<pid_t, ProcessEntry> entries) : entries_(std::move(entries)) {}

  [[nodiscard]] const std::map<pid_t, ProcessEntry>& entries() const { return entries_; }
  [[nodiscard]] std::set<pid_t> children_of(pid_t parent) const;
  /// At whatever depth, without the process itself.
  [[nodiscard]] std::set<pid_t> descendants_of(pid_t ancestor) const;

 private:
  std::map<pid_t, ProcessEntry> entries_;
};

/// What a process and all that it started use of the computer.
struct ResourceUsage {
  double cpu_cores = 0.0;  ///< since the last time it was asked for; 1: one core is busy
  std::int64_t address_bytes = 0;
  std::int64_t memory_bytes = 0;
  bool in_disk_sleep = false;  ///< in a sleep that no signal ends, not even SIGKILL
};

/// Tells it from one look at the table to the next.
class UsageMeter {
 public:
  /// Of the descendants of a process, without itself.
  ResourceUsage measure(const ProcessTable& table, pid_t ancestor, std::int64_t now_us);

 private:
  std::map<pid_t, double> cpu_s_;
  std::optional<std::int64_t> last_us_;
};

/// How busy this computer is, from one look at /proc to the next.
class HostMeter {
 public:
  explicit HostMeter(std::filesystem::path proc = "/proc") : proc_(std::move(proc)) {}

  HostLoad measure();

 private:
  std::filesystem::path proc_;
  double busy_ticks_ = 0.0;
  double all_ticks_ = 0.0;
};

}  // namespace adit
