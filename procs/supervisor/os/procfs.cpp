// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/os/procfs.hpp"

#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <unistd.h>

#include "common/config/number_text.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

// Indices of the fields after the name (proc(5)).
constexpr std::size_t kState = 0;
constexpr std::size_t kParent = 1;
constexpr std::size_t kUserTicks = 11;
constexpr std::size_t kSystemTicks = 12;
constexpr std::size_t kAddressBytes = 20;
constexpr std::size_t kResidentPages = 21;

std::vector<std::string_view> fields_of(std::string_view text) {
  std::vector<std::string_view> fields;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(" \n"), text.size());
    if (end > 0) fields.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return fields;
}

double tick_s() {
  static const double seconds = 1.0 / static_cast<double>(sysconf(_SC_CLK_TCK));
  return seconds;
}

}  // namespace

std::optional<ProcessEntry> parse_process_entry(std::string_view stat) {
  const std::size_t name_end = stat.rfind(')');
  if (name_end == std::string_view::npos) return std::nullopt;
  const auto pid = parse_number<pid_t>(stat.substr(0, stat.find(' ')));
  const std::vector<std::string_view> fields = fields_of(stat.substr(name_end + 1));
  if (!pid || fields.size() <= kResidentPages) return std::nullopt;
  const auto number = [&](std::size_t at) {
    return parse_number<std::int64_t>(fields[at]).value_or(0);
  };
  ProcessEntry entry;
  entry.pid = *pid;
  entry.parent = static_cast<pid_t>(number(kParent));
  entry.state = fields[kState][0];
  entry.cpu_s = static_cast<double>(number(kUserTicks) + number(kSystemTicks)) * tick_s();
  entry.address_bytes = number(kAddressBytes);
  entry.memory_bytes = number(kResidentPages) * sysconf(_SC_PAGESIZE);
  return entry;
}

namespace {

/// Nothing if the process has ended meanwhile.
std::optional<ProcessEntry> read_entry(const fs::path& folder) {
  std::ifstream file(folder / "stat");
  std::string stat;
  std::getline(file, stat, '\0');  // the whole file
  return parse_process_entry(stat);
}

}  // namespace

ProcessTable ProcessTable::read(const fs::path& proc) {
  std::map<pid_t, ProcessEntry> entries;
  std::error_code gone;
  for (const auto& folder : fs::directory_iterator(proc, gone)) {
    const auto pid = parse_number<pid_t>(folder.path().filename().string());
    if (!pid) continue;
    if (const auto entry = read_entry(folder.path())) entries[*pid] = *entry;
  }
  return ProcessTable(std::move(entries));
}

ProcessTable ProcessTable::read_descendants(pid_t ancestor, const fs::path& proc) {
  if (!fs::exists(proc / "self/task" / fs::read_symlink(proc / "self") / "children"))
    return read(proc);
  std::map<pid_t, ProcessEntry> entries;
  std::vector<pid_t> unvisited{ancestor};
  while (!unvisited.empty()) {
    const fs::path folder = proc / std::to_string(unvisited.back());
    unvisited.pop_back();
    std::error_code gone;
    for (const auto& thread : fs::directory_iterator(folder / "task", gone)) {
      std::ifstream children(thread.path() / "children");
      for (pid_t child = 0; children >> child;) {
        const auto entry = read_entry(proc / std::to_string(child));
        if (entry && entries.emplace(child, *entry).second) unvisited.push_back(child);
      }
    }
  }
  return ProcessTable(std::move(entries));
}

std::set<pid_t> ProcessTable::children_of(pid_t parent) const {
  std::set<pid_t> found;
  for (const auto& [pid, entry] : entries_) {
    if (entry.parent == parent) found.insert(pid);
  }
  return found;
}

std::set<pid_t> ProcessTable::descendants_of(pid_t ancestor) const {
  std::set<pid_t> found;
  std::vector<pid_t> unvisited{ancestor};
  while (!unvisited.empty()) {
    const pid_t parent = unvisited.back();
    unvisited.pop_back();
    for (const pid_t child : children_of(parent)) {
      if (child != ancestor && found.insert(child).second) unvisited.push_back(child);
    }
  }
  return found;
}

ResourceUsage UsageMeter::measure(const ProcessTable& table, pid_t ancestor, std::int64_t now_us) {
  const std::map<pid_t, double> before = std::exchange(cpu_s_, {});
  ResourceUsage usage;
  double busy_s = 0.0;
  for (const pid_t pid : table.descendants_of(ancestor)) {
    const ProcessEntry& entry = table.entries().at(pid);
    usage.address_bytes += entry.address_bytes;
    usage.memory_bytes += entry.memory_bytes;
    if (entry.state == 'D') usage.in_disk_sleep = true;
    const auto previous = before.find(pid);
    busy_s += entry.cpu_s - (previous == before.end() ? 0.0 : previous->second);
    cpu_s_[pid] = entry.cpu_s;
  }
  const auto last_us = std::exchange(last_us_, now_us);
  if (last_us && now_us > *last_us && busy_s > 0.0) {
    usage.cpu_cores = busy_s / (static_cast<double>(now_us - *last_us) * 1e-6);
  }
  return usage;
}

namespace {

/// Reads lines such as "MemTotal:  8048404 kB"; returns bytes by name.
std::map<std::string, std::int64_t> read_meminfo(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::map<std::string, std::int64_t> bytes;
  std::string name;
  std::string unit;
  std::int64_t number = 0;
  while (file >> name >> number && std::getline(file, unit)) bytes[name] = number * 1024;
  return bytes;
}

struct Ticks {
  double busy = 0.0;
  double all = 0.0;
};

/// Reads "cpu  user nice system idle iowait irq softirq steal ...", the ticks since boot.
Ticks read_ticks(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string name;
  file >> name;
  Ticks ticks;
  double number = 0.0;
  for (int i = 0; i < 8 && file >> number; ++i) {
    const bool idle = i == 3 || i == 4;
    ticks.all += number;
    if (!idle) ticks.busy += number;
  }
  return ticks;
}

}  // namespace

HostLoad HostMeter::measure() {
  auto memory = read_meminfo(proc_ / "meminfo");
  HostLoad load{0.0, memory["MemTotal:"], memory["MemAvailable:"], memory["SwapTotal:"],
                memory["SwapFree:"]};
  const Ticks ticks = read_ticks(proc_ / "stat");
  const double busy = ticks.busy - std::exchange(busy_ticks_, ticks.busy);
  const double all = ticks.all - std::exchange(all_ticks_, ticks.all);
  if (all > 0.0 && busy > 0.0) load.cpu_share = busy / all;
  return load;
}

}  // namespace adit
