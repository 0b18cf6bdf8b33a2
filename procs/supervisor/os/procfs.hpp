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

/// A process as reported by /proc/PID/stat.
struct ProcessEntry {
  pid_t pid = 0;
  pid_t parent = 0;
  /// Z: zombie; D: uninterruptible sleep, usually disk access.
  char state = '?';
  double cpu_s = 0.0;
  std::int64_t address_bytes = 0;
  std::int64_t memory_bytes = 0;
};

/// Parses /proc/PID/stat; nothing if it is invalid. The name may contain any characters.
std::optional<ProcessEntry> parse_process_entry(std::string_view stat);

/// The processes of this computer. Not an atomic snapshot: processes start and end during the read.
class ProcessTable {
 public:
  static ProcessTable read(const std::filesystem::path& proc = "/proc");
  /// The descendants of `ancestor` alone, without itself: takes as long as they are many, not as
  /// long as all processes are. All processes if the kernel does not list children
  /// (CONFIG_PROC_CHILDREN).
  static ProcessTable read_descendants(pid_t ancestor, const std::filesystem::path& proc = "/proc");
  explicit ProcessTable(std::map<pid_t, ProcessEntry> entries) : entries_(std::move(entries)) {}

  [[nodiscard]] const std::map<pid_t, ProcessEntry>& entries() const { return entries_; }
  [[nodiscard]] std::set<pid_t> children_of(pid_t parent) const;
  /// At any depth, without `ancestor`.
  [[nodiscard]] std::set<pid_t> descendants_of(pid_t ancestor) const;

 private:
  std::map<pid_t, ProcessEntry> entries_;
};

/// Resource usage of a process and all its descendants.
struct ResourceUsage {
  double cpu_cores = 0.0;  ///< mean since the last measurement; 1: one core is busy
  std::int64_t address_bytes = 0;
  std::int64_t memory_bytes = 0;
  bool in_disk_sleep = false;  ///< uninterruptible, even by SIGKILL
};

/// Measures resource usage between successive process tables.
class UsageMeter {
 public:
  /// Usage of the descendants of `ancestor`, without itself.
  ResourceUsage measure(const ProcessTable& table, pid_t ancestor, std::int64_t now_us);

 private:
  std::map<pid_t, double> cpu_s_;
  std::optional<std::int64_t> last_us_;
};

/// Measures the load of this computer between successive reads of /proc.
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
